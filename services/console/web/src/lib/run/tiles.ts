// The twelve figures of the paper's window, for all cars, the equipped and the others.
import type { Figures, Statistics } from '../../generated/console_pb';
import { thinned, type Point } from '../charts/spark';
import { numberText } from '../format';
import type { Row } from './series';

export interface Tile {
  readonly name: string; // key of its name and definition
  readonly unit: string;
  /** Its text for each of all, equipped, unequipped; one alone if it is the same for all. */
  readonly values: readonly string[];
}

interface Figure {
  name: string;
  unit: string;
  of: (figures: Figures) => number | undefined;
  digits: number;
  mean?: boolean; // per car: groups of different sizes can be compared
}

const FIGURES: readonly Figure[] = [
  { name: 'arrived', unit: '', of: (f) => f.arrived, digits: 0 },
  { name: 'waiting', unit: '', of: (f) => f.waitingOutside, digits: 0 },
  { name: 'inSystem', unit: '', of: (f) => f.inSystem, digits: 0 },
  { name: 'left', unit: '', of: (f) => f.left, digits: 0 },
  { name: 'throughput', unit: 'veh/h', of: (f) => f.throughputVehPerH, digits: 0 },
  { name: 'standing', unit: '', of: (f) => f.standing, digits: 0 },
  { name: 'stops', unit: '', of: (f) => f.stops, digits: 0 },
  { name: 'stopsPerCar', unit: '', of: (f) => f.stopsPerVehicle, digits: 3, mean: true },
  { name: 'stopTime', unit: 's', of: (f) => f.stopTimeS, digits: 0 },
  { name: 'meanStopTime', unit: 's', of: (f) => f.meanStopTimeS, digits: 2, mean: true },
  { name: 'meanDelay', unit: 's', of: (f) => f.meanDelayS, digits: 2, mean: true },
];

/** Points of a trend, about. */
const TREND_POINTS = 48;

/** How a figure has gone so far, of the equipped and of the others. */
export interface Trend {
  readonly equipped: readonly Point[];
  readonly unequipped: readonly Point[];
}

/** The trend of each figure, by its name. */
export function trendsOf(rows: readonly Row[]): ReadonlyMap<string, Trend> {
  const few = thinned(rows, TREND_POINTS);
  return new Map(
    FIGURES.map(({ name, of }) => {
      const points = (group: 'equipped' | 'unequipped') =>
        few.map(({ step, statistics }) => {
          const figures = statistics?.[group];
          const value = figures === undefined ? undefined : of(figures);
          return { at: step, value: value === undefined || !Number.isFinite(value) ? null : value };
        });
      return [name, { equipped: points('equipped'), unequipped: points('unequipped') }];
    }),
  );
}

/** By how much the equipped differ from the others; null if that means nothing: of counts, or while there is none. */
export function differenceOf(statistics: Statistics | null, name: string): number | null {
  const figure = FIGURES.find((f) => f.name === name);
  const { equipped, unequipped } = statistics ?? {};
  if (figure === undefined || !figure.mean || equipped === undefined || unequipped === undefined) return null;
  const difference = (figure.of(equipped) ?? NaN) - (figure.of(unequipped) ?? NaN);
  return Number.isFinite(difference) ? difference : null;
}

export function tilesOf(statistics: Statistics | null, stepS: number): Tile[] {
  const groups = [statistics?.all, statistics?.equipped, statistics?.unequipped];
  const time = statistics === null ? undefined : Number(statistics.step) * stepS;
  return [
    { name: 'time', unit: 's', values: [numberText(time, 1)] },
    ...FIGURES.map(({ name, unit, of, digits }) => ({
      name,
      unit,
      values: groups.map((figures) => (figures === undefined ? '–' : numberText(of(figures), digits))),
    })),
  ];
}
