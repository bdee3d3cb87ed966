// Numbers and times as the page writes them.

const TIME_FORMS = ['seconds', 'clock'] as const;
export type TimeForm = (typeof TIME_FORMS)[number];

/** 754.3 s, or 0:12:34.3. */
export function timeText(seconds: number, form: TimeForm): string {
  const tenths = Math.round(seconds * 10);
  if (form === 'seconds') return `${(tenths / 10).toFixed(1)} s`;
  const rest = tenths % 600;
  const minutes = Math.floor(tenths / 600);
  const two = (n: number) => String(n).padStart(2, '0');
  return `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${two(Math.floor(rest / 10))}.${rest % 10}`;
}

export function numberText(value: number | undefined, digits = 0): string {
  return value === undefined || !Number.isFinite(value) ? '–' : value.toFixed(digits);
}

/** 0.7 -> "70 %", in one piece */
export function percentText(share: number | undefined): string {
  return share === undefined || !Number.isFinite(share) ? '–' : `${Math.round(share * 100)}\u00a0%`;
}

/** A speed factor: 0.1, 9.8, 104, 2200. */
export function paceText(pace: number): string {
  return pace >= 20 ? pace.toFixed(0) : pace >= 1 ? pace.toFixed(1) : pace.toFixed(2);
}

export function csvText(rows: readonly (readonly string[])[]): string {
  return rows
    .map((row) => row.map((cell) => (/[",\n]/.test(cell) ? `"${cell.replace(/"/g, '""')}"` : cell)).join(','))
    .join('\n');
}
