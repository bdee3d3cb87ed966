// Commanded accelerations that a rule has changed, out of the running counts of the stored samples.
import type { Row } from './series';

/** In the order of the counts. */
export const RULES = ['limit', 'guard', 'following', 'light', 'driver'] as const;
export type Rule = (typeof RULES)[number];

/** What changes a command against its sense. That the following law asks for less is a matter of course and no event. */
const EVENTS: readonly Rule[] = ['guard', 'limit', 'light', 'driver'];

/** Between two samples. */
export interface Stretch {
  readonly from: number; // step
  readonly to: number;
  readonly changed: readonly [rule: Rule, commands: number][]; // none is zero
}

/** Stretches in which commands were changed, in the order of time; not shorter than `steps`. */
export function overridesIn(rows: readonly Row[], steps: number): Stretch[] {
  const stretches: Stretch[] = [];
  let begin: Row | undefined;
  rows.forEach((row, i) => {
    if (row.statistics === null) begin = undefined;
    else if (begin === undefined) begin = row;
    else if (row.step - begin.step >= steps || i === rows.length - 1 || rows[i + 1].statistics === null) {
      const changed = changedBetween(begin, row);
      if (changed.length > 0) stretches.push({ from: begin.step, to: row.step, changed });
      begin = row;
    }
  });
  return stretches;
}

function changedBetween(before: Row, after: Row): [Rule, number][] {
  const count = (row: Row, rule: Rule) => row.statistics?.overridden[RULES.indexOf(rule)] ?? 0;
  return EVENTS.map((rule): [Rule, number] => [rule, count(after, rule) - count(before, rule)]).filter(
    ([, n]) => n > 0,
  );
}
