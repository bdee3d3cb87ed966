// A line without axes, as small as a word.

export interface Point {
  readonly at: number;
  readonly value: number | null; // null: a gap
}

/** Of many points about `most`, the last one among them. */
export function thinned<T>(points: readonly T[], most: number): readonly T[] {
  const every = Math.max(1, Math.ceil(points.length / most));
  return points.filter((_, i) => (points.length - 1 - i) % every === 0);
}

/** The largest value of all lines; at least a little, so that lines of zeros lie at the bottom. */
export function peakOf(lines: readonly (readonly Point[])[]): number {
  return lines.flat().reduce((peak, { value }) => Math.max(peak, value ?? 0), 1e-9);
}

/** The way of an SVG path over a box: from the first to the last point, from 0 to `peak`. */
export function sparkPath(points: readonly Point[], peak: number, width: number, height: number): string {
  if (points.length === 0) return '';
  const from = points[0].at;
  const span = points[points.length - 1].at - from || 1;
  let way = '';
  let pen = 'M';
  for (const { at, value } of points) {
    if (value === null) {
      pen = 'M';
      continue;
    }
    const x = ((at - from) / span) * width;
    const y = (1 - Math.min(1, Math.max(0, value / peak))) * height;
    way += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
    pen = 'L';
  }
  return way;
}
