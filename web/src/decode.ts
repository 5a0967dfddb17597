/**
 * Small readers that turn `unknown` into typed values and throw a DecodeError that names the path.
 * All of them are pure.
 */

export class DecodeError extends Error {
  constructor(
    readonly path: string,
    readonly expected: string,
    readonly found: unknown,
  ) {
    super(`${path}: expected ${expected}, found ${describe(found)}`);
    this.name = "DecodeError";
  }
}

function describe(value: unknown): string {
  const text = value === undefined ? "nothing" : JSON.stringify(value);
  return text.length > 60 ? `${text.slice(0, 57)}…` : text;
}

/** Reads one value found at `path`; throws DecodeError. */
export type Reader<T> = (value: unknown, path: string) => T;

export const text: Reader<string> = (value, path) => {
  if (typeof value !== "string") throw new DecodeError(path, "a text", value);
  return value;
};

export const flag: Reader<boolean> = (value, path) => {
  if (typeof value !== "boolean") throw new DecodeError(path, "true or false", value);
  return value;
};

/** A finite number. */
export const number: Reader<number> = (value, path) => {
  if (typeof value !== "number" || !Number.isFinite(value)) throw new DecodeError(path, "a number", value);
  return value;
};

/** A number, or null for one that is not finite: read as NaN. */
export const numberOrNaN: Reader<number> = (value, path) => (value === null ? NaN : number(value, path));

export function oneOf<const T extends string>(...choices: readonly T[]): Reader<T> {
  return (value, path) => {
    const found = choices.find((choice) => choice === value);
    if (found === undefined) throw new DecodeError(path, `one of ${choices.join(", ")}`, value);
    return found;
  };
}

export function list<T>(item: Reader<T>): Reader<T[]> {
  return (value, path) => {
    if (!Array.isArray(value)) throw new DecodeError(path, "a list", value);
    return value.map((entry: unknown, index) => item(entry, `${path}[${index}]`));
  };
}

export function orNull<T>(reader: Reader<T>): Reader<T | null> {
  return (value, path) => (value === null ? null : reader(value, path));
}

/** [min, max] with min <= max. */
export const range: Reader<readonly [number, number]> = (value, path) => {
  const [min, max, ...rest] = list(number)(value, path);
  if (min === undefined || max === undefined || rest.length > 0 || min > max)
    throw new DecodeError(path, "[min, max]", value);
  return [min, max];
};

export const vector: Reader<readonly [number, number, number]> = (value, path) => {
  const [x, y, z, ...rest] = list(number)(value, path);
  if (x === undefined || y === undefined || z === undefined || rest.length > 0)
    throw new DecodeError(path, "[x, y, z]", value);
  return [x, y, z];
};

function members(value: unknown, path: string): Map<string, unknown> {
  if (typeof value !== "object" || value === null || Array.isArray(value))
    throw new DecodeError(path, "an object", value);
  return new Map(Object.entries(value));
}

/** An object whose keys are names and whose values all read alike. */
export function dictionary<T>(item: Reader<T>): Reader<Map<string, T>> {
  return (value, path) =>
    new Map([...members(value, path)].map(([key, entry]) => [key, item(entry, `${path}.${key}`)]));
}

type Shape = Record<string, Reader<unknown>>;
type Read<S extends Shape> = { [K in keyof S]: S[K] extends Reader<infer T> ? T : never };

/** An object with exactly these keys: a missing or an unknown one is refused. */
export function object<S extends Shape>(shape: S): Reader<Read<S>> {
  const optionalToo = fields(shape);
  return (value, path) => {
    const result = optionalToo(value, path);
    for (const key of Object.keys(shape))
      if (!(key in result)) throw new DecodeError(`${path}.${key}`, "a value", undefined);
    return result as Read<S>;
  };
}

/** An object with any of these keys; an unknown one is refused. */
export function fields<S extends Shape>(shape: S): Reader<Partial<Read<S>>> {
  return (value, path) => {
    const result: Record<string, unknown> = {};
    for (const [key, entry] of members(value, path)) {
      const reader = Object.hasOwn(shape, key) ? shape[key] : undefined;
      if (reader === undefined) throw new DecodeError(`${path}.${key}`, "no such key", entry);
      result[key] = reader(entry, `${path}.${key}`);
    }
    return result as Partial<Read<S>>;
  };
}
