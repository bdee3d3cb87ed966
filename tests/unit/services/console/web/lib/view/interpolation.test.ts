import { momentBetween } from '@page/lib/view/interpolation';
import { Playback } from '@page/lib/view/playback';
import type { Scene } from '@page/lib/wire/scene';

const scene = (step: number, cars: [number, number, number][]): Scene =>
  ({
    step,
    vehicle: Uint32Array.from(cars, ([vehicle]) => vehicle),
    positionM: Float32Array.from(cars, ([, position]) => position),
    speedMps: Float32Array.from(cars, ([, , speed]) => speed),
  }) as unknown as Scene;

describe('the moment between two pictures', () => {
  it('puts a car between its two places', () => {
    const moment = momentBetween(scene(10, [[7, 100, 10]]), scene(12, [[7, 104, 10]]), 10.5, 0.1);
    expect(moment.positionM[0]).toBe(101); // a quarter of the way
  });

  it('finds cars by their number, not by their place in the list', () => {
    const moment = momentBetween(
      scene(10, [
        [7, 100, 10],
        [8, 50, 0],
      ]),
      scene(11, [
        [8, 50, 0],
        [7, 101, 10],
      ]),
      10.5,
      0.1,
    );
    expect([...moment.positionM]).toEqual([100.5, 50]);
  });

  it('lets a car that has gone drive on at its speed', () => {
    const moment = momentBetween(scene(10, [[7, 100, 10]]), scene(12, []), 11, 0.1);
    expect(moment.positionM[0]).toBe(101); // 10 m/s for 0.1 s
  });

  it('invents nothing between pictures that lie far apart', () => {
    const moment = momentBetween(scene(10, [[7, 100, 10]]), scene(110, [[7, 200, 10]]), 60, 0.1);
    expect(moment.positionM[0]).toBe(100);
  });

  it('is the later picture once its step has come', () => {
    const after = scene(11, [[7, 101, 10]]);
    expect(momentBetween(scene(10, [[7, 100, 10]]), after, 11, 0.1).scene).toBe(after);
  });
});

describe('the playback', () => {
  it('reaches a picture after the time that pictures are apart', () => {
    const playback = new Playback();
    for (let i = 0; i <= 20; ++i) playback.arrived(i, 1000 + 100 * i); // 100 ms a step
    expect(playback.stepAt(3000)).toBeCloseTo(19, 3);
    expect(playback.stepAt(3050)).toBeCloseTo(19.5, 2);
    expect(playback.stepAt(3100)).toBeCloseTo(20, 2);
    expect(playback.stepAt(9000)).toBe(20); // and stays there
  });

  it('never goes back while pictures come unevenly', () => {
    const playback = new Playback();
    let last = -1;
    let at = 0;
    for (let i = 0; i < 60; ++i) {
      at += i % 3 === 0 ? 20 : 140;
      playback.arrived(i, at);
      for (const later of [0, 10, 19]) {
        const step = playback.stepAt(at + later);
        expect(step).toBeGreaterThanOrEqual(last);
        last = step;
      }
    }
  });

  it('shows the newest at once when steps are far apart or begin anew', () => {
    const playback = new Playback();
    playback.arrived(5, 0);
    playback.arrived(500, 30);
    expect(playback.stepAt(30)).toBe(500);
    playback.arrived(0, 60);
    expect(playback.stepAt(60)).toBe(0);
  });
});
