import { aligned } from '@page/lib/charts/aligned';

it('puts lines over all their places, straight in between and nothing beyond their ends', () => {
  const columns = aligned([
    { x: [0, 10], y: [0, 5] },
    { x: [4, 20], y: [1, 1] },
  ]);
  expect(columns).toEqual([
    [0, 4, 10, 20],
    [0, 2, 5, null],
    [null, 1, 1, 1],
  ]);
});

it('holds the value of a line of steps until its next place', () => {
  const columns = aligned([
    { x: [0, 10], y: [3, 7], steps: true },
    { x: [9, 11], y: [0, 0] },
  ]);
  expect(columns[1]).toEqual([3, 3, 7, null]);
});

it('leaves a gap where a line has one', () => {
  const columns = aligned([
    { x: [0, 2, 4], y: [1, null, 1] },
    { x: [1, 3], y: [0, 0] },
  ]);
  expect(columns[1]).toEqual([1, null, null, null, 1]);
});
