// The twelve figures of the paper's window, for all cars, the equipped and the others.
import type { Figures, Statistics } from '../../generated/console_pb';
import { numberText } from '../format';

export interface Tile {
  readonly name: string; // key of its name and definition
  readonly unit: string;
  /** Its text for each of all, equipped, unequipped; one alone if it is the same for all. */
  readonly values: readonly string[];
}

const FIGURES: { name: string; unit: string; of: (figures: Figures) => number | undefined; digits: number }[] = [
  { name: 'arrived', unit: '', of: (f) => f.arrived, digits: 0 },
  { name: 'waiting', unit: '', of: (f) => f.waitingOutside, digits: 0 },
  { name: 'inSystem', unit: '', of: (f) => f.inSystem, digits: 0 },
  { name: 'left', unit: '', of: (f) => f.left, digits: 0 },
  { name: 'throughput', unit: 'veh/h', of: (f) => f.throughputVehPerH, digits: 0 },
  { name: 'standing', unit: '', of: (f) => f.standing, digits: 0 },
  { name: 'stops', unit: '', of: (f) => f.stops, digits: 0 },
  { name: 'stopsPerCar', unit: '', of: (f) => f.stopsPerVehicle, digits: 3 },
  { name: 'stopTime', unit: 's', of: (f) => f.stopTimeS, digits: 0 },
  { name: 'meanStopTime', unit: 's', of: (f) => f.meanStopTimeS, digits: 2 },
  { name: 'meanDelay', unit: 's', of: (f) => f.meanDelayS, digits: 2 },
];

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
