// The speeds of the paper's window, and as fast as possible.

export const PRESETS = [
  { key: 'verySlow', pace: 0.1, word: 'very-slow' },
  { key: 'slow', pace: 1, word: 'slow' },
  { key: 'medium', pace: 10, word: 'medium' },
  { key: 'fast', pace: 100, word: 'fast' },
  { key: 'max', pace: 0, word: 'max' },
] as const;

/** The preset after (`by` 1) or before (-1) a pace; as fast as possible (0) is the fastest. */
export function neighbour(pace: number, by: 1 | -1): string {
  const fastness = (p: number) => (p === 0 ? Infinity : p);
  const now = fastness(pace);
  const ordered = by > 0 ? PRESETS : [...PRESETS].reverse();
  const next = ordered.find((preset) => (by > 0 ? fastness(preset.pace) > now : fastness(preset.pace) < now));
  return (next ?? ordered[ordered.length - 1]).word;
}

/** Ends of the speed's slider, which goes by powers of ten; at its upper end it means as fast as possible. */
export const SLOWEST = -1;
export const FASTEST = 3;

/** Where a pace stands on the slider. */
export function placeOf(pace: number): number {
  return pace <= 0 ? FASTEST : Math.min(FASTEST, Math.max(SLOWEST, Math.log10(pace)));
}

/** What a place on the slider asks for, in two digits: "0.25", "37", "max". */
export function paceAt(place: number): string {
  return place >= FASTEST ? 'max' : String(Number((10 ** place).toPrecision(2)));
}
