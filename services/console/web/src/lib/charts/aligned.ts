// Lines that were sampled at places of their own, over one common axis.
import type { Columns } from './plot';

export interface Sampled {
  readonly x: readonly number[]; // rising
  readonly y: readonly (number | null)[]; // null: a gap
  /** Holds each value until the next one; otherwise straight from one to the next. */
  readonly steps?: boolean;
}

/** All places of all lines, and of each line its value there: between two of its places in between, beyond them none. */
export function aligned(lines: readonly Sampled[]): Columns {
  const places = [...new Set(lines.flatMap(({ x }) => x))].sort((a, b) => a - b);
  return [places, ...lines.map((line) => valuesAt(places, line))];
}

function valuesAt(places: readonly number[], { x, y, steps = false }: Sampled): (number | null)[] {
  let next = 0; // the first of the line's places that is not before
  return places.map((at) => {
    while (next < x.length && x[next] < at) ++next;
    if (next === x.length) return null;
    if (x[next] === at) return y[next];
    if (next === 0) return null;
    const before = y[next - 1];
    const after = y[next];
    if (before === null || after === null) return null;
    if (steps) return before;
    return before + ((after - before) * (at - x[next - 1])) / (x[next] - x[next - 1]);
  });
}
