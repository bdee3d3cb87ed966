import { CHARTS, columnsOf, compares, ghostColumn, rowsOf, seriesRows, type Chart } from '@page/lib/run/series';
import type { Sample } from '@page/lib/run/console.svelte';

const sample = (step: number, delay?: number): Sample =>
  ({ step, statistics: { all: { meanDelayS: delay }, queue: [1, 2] } }) as unknown as Sample;
const chart = (name: string): Chart => CHARTS.find((c) => c.name === name)!;

describe('the columns of a chart', () => {
  it('have a time and a value per sample, and a gap where there is no value', () => {
    const [times, all, equipped] = columnsOf(chart('delay'), [sample(10), sample(20, 3.5)], 0.1);
    expect(times).toEqual([1, 2]);
    expect(all).toEqual([null, 3.5]);
    expect(equipped).toEqual([null, null]);
  });

  it('of the queue are one for each lane', () => {
    expect(columnsOf(chart('queue'), [sample(10)], 0.1)).toHaveLength(13);
  });

  it('take the ghost at its newest value up to each time, and nothing where it has ended', () => {
    const ghost = [sample(10, 1), sample(20, 2), sample(30, 3)];
    const now = [sample(5), sample(10), sample(25), sample(30), sample(31)];
    expect(ghostColumn(chart('delay'), ghost, now)).toEqual([null, 1, 2, 3, null]);
  });

  it('join nothing across a jump of a recording', () => {
    const jumped = (step: number, seeks: number, delay: number): Sample =>
      ({ step, statistics: { seeks, all: { meanDelayS: delay } } }) as unknown as Sample;
    const rows = rowsOf([jumped(10, 0, 1), jumped(20, 0, 2), jumped(60, 1, 6), jumped(70, 1, 7)]);
    const [times, all] = columnsOf(chart('delay'), rows, 0.1);
    expect(times).toEqual([1, 2, 4, 6, 7]);
    expect(all).toEqual([1, 2, null, 6, 7]);
  });

  it('are saved with a name each, empty where there is no value', () => {
    const [head, row] = seriesRows([sample(20, 3.5)], 0.1);
    expect(head.slice(0, 4)).toEqual(['time_s', 'stopTime.all', 'stopTime.equipped', 'stopTime.unequipped']);
    expect(row[0]).toBe('2.0');
    expect(row[head.indexOf('delay.all')]).toBe('3.5');
    expect(row[head.indexOf('delay.equipped')]).toBe('');
    expect(row).toHaveLength(head.length);
  });

  it('can be compared where they show all cars', () => {
    expect(CHARTS.filter(compares).map(({ name }) => name)).toEqual(['stopTime', 'throughput', 'delay']);
  });
});
