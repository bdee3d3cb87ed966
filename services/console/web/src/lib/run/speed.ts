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
