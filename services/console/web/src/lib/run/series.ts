// Columns for the charts, out of the stored samples.
import type { Statistics } from '../../generated/console_pb';
import type { Columns } from '../charts/plot';
import { LANES } from '../wire/scene';
import type { Sample } from './console.svelte';

export type Column = (number | null)[];

/** A place on the time axis; without statistics no line goes through it. */
export interface Row {
  readonly step: number;
  readonly statistics: Statistics | null;
}

export interface Line {
  readonly label: string; // key of the page's words, or a lane
  readonly of: (statistics: Statistics) => number | undefined;
}

export interface Chart {
  readonly name: string;
  readonly lines: readonly Line[];
}

const groups = (of: (figures: Statistics['all'] & {}) => number | undefined): Line[] => [
  { label: 'tile.all', of: (s) => s.all && of(s.all) },
  { label: 'tile.equipped', of: (s) => s.equipped && of(s.equipped) },
  { label: 'tile.unequipped', of: (s) => s.unequipped && of(s.unequipped) },
];

export const CHARTS: readonly Chart[] = [
  { name: 'stopTime', lines: groups((f) => f.meanStopTimeS) },
  { name: 'throughput', lines: groups((f) => f.throughputVehPerH) },
  { name: 'queue', lines: LANES.map((lane, i) => ({ label: lane, of: (s: Statistics) => s.queue[i] })) },
  { name: 'delay', lines: groups((f) => f.meanDelayS) },
  { name: 'pace', lines: [{ label: 'chart.achieved', of: (s) => s.paceAchieved }] },
  {
    name: 'delivery',
    lines: [
      { label: 'chart.up', of: (s) => s.deliveryRatioUp },
      { label: 'chart.down', of: (s) => s.deliveryRatioDown },
    ],
  },
  {
    name: 'latency',
    lines: [
      { label: 'chart.up', of: (s) => s.latencyUpMs },
      { label: 'chart.down', of: (s) => s.latencyDownMs },
    ],
  },
];

/** The samples, with a gap wherever a recording has jumped between two. */
export function rowsOf(samples: readonly Sample[]): Row[] {
  const rows: Row[] = [];
  samples.forEach((sample, i) => {
    const before = samples[i - 1];
    if (before !== undefined && before.statistics.seeks !== sample.statistics.seeks) {
      rows.push({ step: (before.step + sample.step) / 2, statistics: null });
    }
    rows.push(sample);
  });
  return rows;
}

/** Time [s] and a column per line. */
export function columnsOf(chart: Chart, rows: readonly Row[], stepS: number): Columns {
  return [rows.map(({ step }) => step * stepS), ...chart.lines.map((line) => columnOf(line, rows))];
}

function columnOf(line: Line, rows: readonly Row[]): Column {
  return rows.map(({ statistics }) => (statistics === null ? null : numberOrGap(line.of(statistics))));
}

/** All charts' values over time, a row per sample. */
export function seriesRows(samples: readonly Sample[], stepS: number): string[][] {
  const lines = CHARTS.flatMap((chart) => chart.lines.map((line) => ({ chart, line })));
  const names = lines.map(({ chart, line }) => `${chart.name}.${line.label.replace(/^\w+\./, '')}`);
  const text = (value: number | undefined) => (numberOrGap(value) === null ? '' : String(value));
  return [
    ['time_s', ...names],
    ...samples.map(({ step, statistics }) => [
      (step * stepS).toFixed(1),
      ...lines.map(({ line }) => text(line.of(statistics))),
    ]),
  ];
}

/** Charts that can be compared with a ghost: those whose first line is all cars. */
export const compares = (chart: Chart) => chart.lines[0].label === 'tile.all';

/** The ghost's line of all cars at the times of `rows`: at each its newest value up to then. */
export function ghostColumn(chart: Chart, ghost: readonly Sample[], rows: readonly Row[]): Column {
  let at = -1;
  return rows.map(({ step }) => {
    while (at + 1 < ghost.length && ghost[at + 1].step <= step) ++at;
    const ended = at === ghost.length - 1 && ghost[at]?.step < step;
    return at < 0 || ended ? null : numberOrGap(chart.lines[0].of(ghost[at].statistics));
  });
}

function numberOrGap(value: number | undefined): number | null {
  return value === undefined || !Number.isFinite(value) ? null : value;
}
