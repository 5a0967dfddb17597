/** Marks of changes on the time axis: those too close to be told apart on the screen become one. */

export type Mark = { readonly time_s: number; readonly text: string };

export type Group = {
  /** where the line is drawn: the time of the last mark of the group */
  readonly time_s: number;
  /** text of the last mark, with the number of the others */
  readonly label: string;
  /** all of the group, one a line */
  readonly detail: string;
};

/**
 * @param marks  in order of time
 * @param apart  least distance of two lines [s]
 */
export function groupMarks(marks: readonly Mark[], apart: number): Group[] {
  const groups: Mark[][] = [];
  for (const mark of marks) {
    const open = groups.at(-1);
    if (open?.[0] && mark.time_s - open[0].time_s < apart) open.push(mark);
    else groups.push([mark]);
  }
  return groups.map((group) => {
    const last = group[group.length - 1] as Mark;
    const others = group.length - 1;
    return {
      time_s: last.time_s,
      label: others > 0 ? `${last.text} (+${others})` : last.text,
      detail: group.map(({ time_s, text }) => `${time_s.toFixed(2)} s: ${text}`).join("\n"),
    };
  });
}

/** Where the text of a mark goes: a row, and whether it stands left of its line. */
export type Place = { readonly row: number; readonly left: boolean };

/**
 * Rows for the texts of marks, so that none lies upon another; the newest ones are placed first. What finds no room keeps
 * its line, whose title tells it.
 * @param at  places of the lines [px], ascending
 * @param lengths  of the texts [px]
 * @param width  of the plot [px]
 * @param rows  how many there are
 */
export function placeLabels(at: readonly number[], lengths: readonly number[], width: number, rows: number): (Place | null)[] {
  const places: (Place | null)[] = at.map(() => null);
  const taken: [number, number][][] = Array.from({ length: rows }, () => []);
  for (let i = at.length - 1; i >= 0; i--) {
    const [x, length] = [at[i] as number, lengths[i] as number];
    const left = x + length > width;
    const [from, to] = left ? [x - length, x] : [x, x + length];
    const row = taken.findIndex((others) => others.every(([begin, end]) => to <= begin || from >= end));
    if (row < 0) continue;
    taken[row]?.push([from, to]);
    places[i] = { row, left };
  }
  return places;
}
