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
