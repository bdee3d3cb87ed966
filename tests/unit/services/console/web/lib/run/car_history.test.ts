import { lossesOf, planeTrail, seenOf } from '@page/lib/run/car_history';
import { ThinningRing } from '@page/lib/run/ring';
import type { Scene } from '@page/lib/wire/scene';

/** Car 8 alone, or behind car 4. */
const scene = (step: number, change: Partial<Record<'uplink' | 'missed', number>> = {}, vehicles = [8]): Scene =>
  ({
    step,
    vehicle: Uint32Array.from(vehicles),
    lane: new Uint8Array(vehicles.length),
    positionM: Float32Array.from(vehicles, (_, i) => 100 - 20 * i),
    speedMps: Float32Array.from(vehicles, (_, i) => 10 + 2 * i),
    uplink: new Uint8Array(vehicles.length).fill(change.uplink ?? 0),
    missed: new Uint8Array(vehicles.length).fill(change.missed ?? 255),
  }) as unknown as Scene;

const ring = (...scenes: Scene[]) => {
  const made = new ThinningRing<Scene>(100);
  for (const one of scenes) made.push(one);
  return made;
};
const steps = (seen: ReturnType<typeof seenOf>) => seen.map((s) => s.scene.step);

describe('the last minute of a car', () => {
  it('reaches back as far as it was seen without a break, and not beyond the minute', () => {
    const scenes = ring(scene(10), scene(20, {}, [4]), scene(30), scene(40, {}, [4, 8]), scene(50));
    expect(steps(seenOf(scenes, 8, 50, 600))).toEqual([30, 40, 50]);
    expect(steps(seenOf(scenes, 8, 45, 5))).toEqual([40]);
    expect(steps(seenOf(scenes, 99, 50, 600))).toEqual([]);
  });

  it('has a place in the plane of figure 5 where a car is ahead', () => {
    const seen = seenOf(ring(scene(10), scene(20, {}, [4, 8])), 8, 20, 600);
    expect(planeTrail(seen)).toEqual([{ closingMps: 2, gapM: 20, aheadMps: 10 }]);
  });
});

describe('the losses of a car', () => {
  const of = (...scenes: Scene[]) => lossesOf(seenOf(ring(...scenes), 8, 1000, 1000));

  it('are told by direction and cause, newest first', () => {
    expect(of(scene(10, { uplink: 2 }), scene(20), scene(30, { missed: 13 }), scene(40))).toEqual([
      { up: false, cause: 'fate.13', from: 30, to: 30 },
      { up: true, cause: 'cause.burst', from: 10, to: 10 },
    ]);
  });

  it('that follow each other with one cause are one', () => {
    const burst = { uplink: 2 };
    expect(of(scene(10, burst), scene(20, burst), scene(30, { uplink: 1 }))).toEqual([
      { up: true, cause: 'cause.random', from: 30, to: 30 },
      { up: true, cause: 'cause.burst', from: 10, to: 20 },
    ]);
  });

  it('are none of a car that is heard, or that sends nothing', () => {
    expect(of(scene(10), scene(20, { uplink: 255 }))).toEqual([]);
  });
});
