import { ThinningRing } from '@page/lib/run/ring';

const filled = (capacity: number, steps: number) => {
  const ring = new ThinningRing<{ step: number }>(capacity);
  for (let step = 0; step < steps; ++step) ring.push({ step });
  return ring;
};
const steps = (ring: ThinningRing<{ step: number }>) => ring.all().map((item) => item.step);

describe('the store of samples', () => {
  it('keeps everything while there is room', () => {
    expect(steps(filled(8, 8))).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
  });

  it('drops every second sample of the older half when it is full', () => {
    // Nine samples, the older half are the first four: 1 and 3 go.
    expect(steps(filled(8, 9))).toEqual([0, 2, 4, 5, 6, 7, 8]);
  });

  it('never outgrows its capacity, reaches back to the beginning and keeps the newest whole', () => {
    const ring = filled(100, 100_000);
    expect(ring.length).toBeLessThanOrEqual(100);
    expect(ring.first).toEqual({ step: 0 });
    expect(steps(ring).slice(-50)).toEqual(Array.from({ length: 50 }, (_, i) => 99_950 + i));
  });

  it('replaces the sample of a step that comes again', () => {
    const ring = new ThinningRing<{ step: number; text: string }>(4);
    ring.push({ step: 1, text: 'a' });
    ring.push({ step: 1, text: 'b' });
    expect(ring.all()).toEqual([{ step: 1, text: 'b' }]);
  });

  it('drops what comes again when the steps go back', () => {
    const ring = filled(8, 5);
    ring.push({ step: 2 });
    expect(steps(ring)).toEqual([0, 1, 2]);
    ring.push({ step: 0 });
    expect(steps(ring)).toEqual([0]);
  });

  it('finds the last sample at or before a step', () => {
    const ring = filled(8, 9); // 0 2 4 5 6 7 8
    expect([ring.indexAt(-1), ring.indexAt(0), ring.indexAt(3), ring.indexAt(4), ring.indexAt(99)]).toEqual([
      -1, 0, 1, 2, 6,
    ]);
  });
});
