// Where a car stands: from metres along its lane's path to the plane. x to the east, y to the north, metres.
import type { LanePath } from '../../generated/console_pb';

export interface Place {
  xM: number;
  yM: number;
}

export class Path {
  readonly name: string;
  readonly stopLineM: number;
  readonly lengthM: number;
  private readonly x: Float64Array;
  private readonly y: Float64Array;
  private readonly s: Float64Array;

  constructor(lane: LanePath) {
    this.name = lane.name;
    this.stopLineM = lane.stopLineM;
    this.x = Float64Array.from(lane.points, (p) => p.xM);
    this.y = Float64Array.from(lane.points, (p) => p.yM);
    this.s = Float64Array.from(lane.distanceM);
    this.lengthM = this.s[this.s.length - 1] ?? 0;
  }

  /** The place at `distanceM`; before the entrance and beyond the end along the first and last stretch. */
  at(distanceM: number, into: Place): Place {
    const { s } = this;
    let low = 1;
    let high = s.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (s[middle] < distanceM) low = middle + 1;
      else high = middle;
    }
    const from = low - 1;
    const share = (distanceM - s[from]) / (s[low] - s[from]);
    into.xM = this.x[from] + share * (this.x[low] - this.x[from]);
    into.yM = this.y[from] + share * (this.y[low] - this.y[from]);
    return into;
  }

  place(distanceM: number): Place {
    return this.at(distanceM, { xM: 0, yM: 0 });
  }

  /** Unit vector along the path at `distanceM`. */
  direction(distanceM: number): Place {
    const a = this.place(distanceM - 0.05);
    const b = this.place(distanceM + 0.05);
    const length = Math.hypot(b.xM - a.xM, b.yM - a.yM) || 1;
    return { xM: (b.xM - a.xM) / length, yM: (b.yM - a.yM) / length };
  }

  /** Its points between two distances, both ends included. */
  stretch(fromM: number, toM: number): Place[] {
    const places = [this.place(fromM)];
    for (let i = 0; i < this.s.length; ++i) {
      if (this.s[i] > fromM && this.s[i] < toM) places.push({ xM: this.x[i], yM: this.y[i] });
    }
    places.push(this.place(toM));
    return places;
  }
}
