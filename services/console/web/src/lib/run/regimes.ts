// The regimes of the following law in the plane of the paper's figure 5, as docs/model.md gives them.
import { parseText, type Field } from '../plan/text_format';

export type Regime = 'free' | 'brake' | 'recover' | 'approach' | 'away' | 'follow';

export class FollowingPlane {
  private constructor(
    readonly reactionM: number, // from here on a car drives freely
    private readonly safeTimeS: number,
    private readonly standstillM: number,
    private readonly bandNear: number,
    private readonly perceptionPerMS: number,
    private readonly perceptionFloorMps: number,
  ) {}

  /** The plane of a scenario, text format; null if it does not say all of it. */
  static of(scenario: string): FollowingPlane | null {
    let fields: Field[];
    try {
      fields = parseText(scenario);
    } catch {
      return null;
    }
    const message = (name: string) => {
      const value = fields.find((field) => field.name === name)?.value;
      return typeof value === 'object' ? value : [];
    };
    const number = (of: readonly Field[], name: string) => Number(of.find((f) => f.name === name)?.value ?? NaN);
    const driving = message('driving');
    const numbers: [number, number, number, number, number, number] = [
      number(driving, 'reaction_distance_m'),
      number(driving, 'safe_time_s'),
      number(driving, 'standstill_spacing_m'),
      number(driving, 'band_near'),
      number(driving, 'perception_threshold_radps') / number(message('vehicles'), 'width_m'),
      number(driving, 'perception_floor_mps'),
    ];
    return numbers.every(Number.isFinite) ? new FollowingPlane(...numbers) : null;
  }

  /** S: equation (8). */
  safeM(aheadMps: number): number {
    return Math.max(this.safeTimeS * aheadMps, this.standstillM);
  }

  /** Nearer than this a driver brakes, unless the car ahead moves away. */
  brakeM(aheadMps: number): number {
    return this.safeM(aheadMps) / this.bandNear;
  }

  /** th: equation (6). */
  perceivedMps(gapM: number): number {
    return Math.max(this.perceptionFloorMps, this.perceptionPerMS * gapM * gapM);
  }

  /** Of a car `gapM` behind another, head to head, `closingMps` faster than that one. */
  regime(gapM: number, closingMps: number, aheadMps: number): Regime {
    if (gapM >= this.reactionM) return 'free';
    const perceivedMps = this.perceivedMps(gapM);
    if (gapM < this.brakeM(aheadMps) && closingMps >= -perceivedMps) return 'brake';
    if (gapM < this.safeM(aheadMps) && closingMps < 0) return 'recover';
    if (closingMps > perceivedMps) return 'approach';
    return closingMps < -perceivedMps ? 'away' : 'follow';
  }
}
