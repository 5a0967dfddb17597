/** Which columns are plotted together: from column names (docs/protocol.md, series.csv) to panels. */

export type Trace = {
  /** index into the columns */
  readonly column: number;
  /** short name for the legend */
  readonly label: string;
  /** index into the palette */
  readonly colour: number;
  /** drawn before anyone chooses otherwise */
  readonly shown: boolean;
};

export type Panel = {
  readonly id: string;
  readonly title: string;
  readonly unit: string;
  readonly traces: readonly Trace[];
  /** on the page before anyone chooses otherwise */
  readonly shown: boolean;
  /** smallest span of the value axis, so that noise about nothing does not look like a signal */
  readonly leastSpan: number;
};

type Column = { index: number; owner: string; quantity: string; unit: string };

const UNITS: readonly { suffix: string; unit: string; leastSpan: number }[] = [
  { suffix: "_nm", unit: "N m", leastSpan: 1 },
  { suffix: "_n", unit: "N", leastSpan: 1 },
  { suffix: "_deg", unit: "deg", leastSpan: 0.2 },
  { suffix: "_m3", unit: "m3", leastSpan: 0.0001 },
  { suffix: "_pa", unit: "Pa", leastSpan: 10 },
  { suffix: "_j", unit: "J", leastSpan: 0.001 },
  { suffix: "_m", unit: "m", leastSpan: 0.01 },
  { suffix: "_s", unit: "s", leastSpan: 0.01 },
];

/** One kind of panel: which quantities it takes, and whether each body has its own. */
type Rule = {
  id: string;
  title: string;
  takes: RegExp;
  perOwner: boolean;
  shown: boolean;
  /** quantities drawn at first; the others wait in the legend */
  first: RegExp;
  /** the same where several owners share the panel */
  firstOfMany?: RegExp;
  /** what is left of a quantity's name in a legend */
  shorten: (quantity: string) => string;
};

const ANY = /./;
const asIs = (quantity: string): string => quantity;

const RULES: readonly Rule[] = [
  { id: "translation", title: "Motion", takes: /^(surge|sway|heave)_m$/, perOwner: true, shown: true, first: ANY, shorten: asIs },
  { id: "rotation", title: "Rotation", takes: /^(roll|pitch|yaw)_deg$/, perOwner: true, shown: true, first: ANY, shorten: asIs },
  { id: "tension", title: "Line tension", takes: /tension_n$/, perOwner: false, shown: true, first: /^(fairlead|anchor)/, firstOfMany: /^fairlead/, shorten: (quantity) => quantity.replace(/_?tension$/, "") },
  { id: "elevation", title: "Wave elevation", takes: /^elevation_m$/, perOwner: false, shown: true, first: ANY, shorten: () => "" },
  { id: "force", title: "Water force", takes: /^fluid_f[xyz]_n$/, perOwner: true, shown: true, first: /fz/, shorten: forceName },
  { id: "pressure", title: "Pressure", takes: /^pressure_pa$/, perOwner: false, shown: true, first: ANY, shorten: () => "" },
  { id: "run_up", title: "Run-up", takes: /^run_up_m$/, perOwner: false, shown: true, first: ANY, shorten: () => "" },
  { id: "slamming", title: "Slamming force", takes: /^slam_f[xyz]_n$/, perOwner: false, shown: true, first: /fz/, shorten: (quantity) => forceName(quantity.replace("slam", "fluid")) },
  { id: "green_volume", title: "Water on deck, volume", takes: /^green_volume_m3$/, perOwner: false, shown: true, first: ANY, shorten: () => "" },
  { id: "green_height", title: "Water on deck, height", takes: /^green_height_m$/, perOwner: false, shown: true, first: ANY, shorten: () => "" },
  { id: "energy", title: "Energy", takes: /^.*_j$/, perOwner: true, shown: true, first: ANY, shorten: asIs },
  { id: "moment", title: "Water moment", takes: /^fluid_m[xyz]_nm$/, perOwner: true, shown: false, first: ANY, shorten: (quantity) => quantity.replace("fluid_m", "about ") },
  { id: "touchdown", title: "Line on the bed", takes: /^touchdown_m$/, perOwner: false, shown: true, first: ANY, shorten: () => "" },
];

function forceName(quantity: string): string {
  return quantity === "fluid_fz" ? "vertical" : quantity.replace("fluid_f", "along ");
}

/** "ship.surge_m" → owner "ship", quantity "surge", unit "m". */
function parseColumn(name: string, index: number): Column & { full: string } {
  const dot = name.indexOf(".");
  const owner = dot < 0 ? "" : name.slice(0, dot);
  const full = name.slice(dot + 1);
  const found = UNITS.find(({ suffix }) => full.endsWith(suffix));
  const quantity = found ? full.slice(0, -found.suffix.length) : full;
  return { index, owner, full, quantity, unit: found?.unit ?? "" };
}

/** Panels of a run in the order they are shown; every column but the time is in exactly one. */
export function panelsOf(columns: readonly string[]): Panel[] {
  const parsed = columns.map(parseColumn).slice(1);
  const ruleOf = (column: { full: string }): Rule | undefined => RULES.find(({ takes }) => takes.test(column.full));
  const panels = RULES.flatMap((rule) => {
    const mine = parsed.filter((column) => ruleOf(column) === rule);
    const owners = [...new Set(mine.map(({ owner }) => owner))];
    if (!rule.perOwner) return mine.length > 0 ? [panelOf(rule, rule.id, rule.title, mine)] : [];
    return owners.map((owner) =>
      panelOf(
        rule,
        `${rule.id}.${owner}`,
        owners.length > 1 ? `${rule.title}, ${readable(owner)}` : rule.title,
        mine.filter((column) => column.owner === owner),
      ),
    );
  });
  const others = parsed.filter((column) => !ruleOf(column));
  for (const unit of new Set(others.map((column) => column.unit))) {
    const rule: Rule = { id: "other", title: "Other", takes: ANY, perOwner: false, shown: false, first: ANY, shorten: asIs };
    panels.push(panelOf(rule, `other.${unit}`, "Other", others.filter((column) => column.unit === unit)));
  }
  return panels;
}

function panelOf(rule: Rule, id: string, title: string, columns: readonly Column[]): Panel {
  const manyOwners = !rule.perOwner && new Set(columns.map(({ owner }) => owner)).size > 1;
  const unit = columns[0]?.unit ?? "";
  const first = (manyOwners ? rule.firstOfMany : undefined) ?? rule.first;
  const traces = columns.map(({ index, owner, quantity }, colour) => {
    const short = readable(rule.shorten(quantity));
    const label = manyOwners || short === "" ? `${readable(owner)} ${short}`.trim() : short;
    return { column: index, label, colour, shown: first.test(quantity) };
  });
  // primary traces take the palette's first colours, whatever the order of the columns
  const ordered = [...traces].sort((a, b) => Number(b.shown) - Number(a.shown));
  return {
    id,
    title,
    unit,
    traces: ordered.map((trace, colour) => ({ ...trace, colour })),
    shown: rule.shown,
    leastSpan: UNITS.find((entry) => entry.unit === unit)?.leastSpan ?? 0,
  };
}

function readable(name: string): string {
  return name.replaceAll("_", " ");
}
