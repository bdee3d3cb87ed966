import { FollowingPlane } from '@page/lib/run/regimes';

const DRIVING = `driving { safe_time_s: 1.98 standstill_spacing_m: 5.5 reaction_distance_m: 150 band_near: 1.1
  perception_threshold_radps: 0.0006 perception_floor_mps: 0.02 }`;
const plane = FollowingPlane.of(`vehicles { width_m: 1.8 } ${DRIVING}`)!;

describe('the plane of figure 5 behind a car at 10 m/s', () => {
  it('has its lines where the figure has them', () => {
    expect(plane.safeM(10)).toBeCloseTo(19.8);
    expect(plane.brakeM(10)).toBeCloseTo(18);
    expect(plane.safeM(0)).toBe(5.5);
    expect(plane.perceivedMps(30)).toBeCloseTo(0.3);
    expect(plane.perceivedMps(150)).toBeCloseTo(7.5);
    expect(plane.perceivedMps(1)).toBe(0.02);
  });

  it.each([
    [150, 3, 'free'],
    [17, 0, 'brake'],
    [17, 2, 'brake'],
    [17, -0.05, 'brake'], // not perceived: 0.0963 m/s would be
    [17, -0.2, 'recover'],
    [19, -0.05, 'recover'],
    [19, 0.05, 'follow'],
    [30, 0.2, 'follow'],
    [30, 0.5, 'approach'],
    [30, -0.5, 'away'],
  ])('at %d m and %d m/s: %s', (gapM, closingMps, regime) => {
    expect(plane.regime(gapM, closingMps, 10)).toBe(regime);
  });

  it('is not known from a scenario that does not say it', () => {
    expect(FollowingPlane.of(DRIVING)).toBeNull();
    expect(FollowingPlane.of('driving {')).toBeNull();
    expect(FollowingPlane.of('')).toBeNull();
  });
});
