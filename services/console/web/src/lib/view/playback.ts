// Which step the picture shows at an instant of the wall clock, so that cars move smoothly between steps at slow paces.

/** Above this distance between two pictures [steps] nothing is invented between them: the newest is shown as it is. */
export const SMOOTH_STEPS = 20;

export class Playback {
  private from = -1;
  private to = -1;
  private startMs = 0;
  private spanMs = 100;
  private lastArrivalMs = -1;

  /** A picture of `step` has come at `nowMs`. */
  arrived(step: number, nowMs: number): void {
    if (this.to < 0 || step < this.to || step - this.to > SMOOTH_STEPS) {
      this.from = step;
    } else {
      this.from = this.stepAt(nowMs);
      const gapMs = nowMs - this.lastArrivalMs;
      // Half of a new distance is taken at once; a pause of the run is not a pace.
      if (gapMs < 15_000) this.spanMs = Math.max(1, (this.spanMs + gapMs) / 2);
    }
    this.to = step;
    this.startMs = nowMs;
    this.lastArrivalMs = nowMs;
  }

  /** The step to show, with its fraction; -1 before the first picture. */
  stepAt(nowMs: number): number {
    if (this.to < 0) return -1;
    const share = Math.min(1, Math.max(0, (nowMs - this.startMs) / this.spanMs));
    return this.from + (this.to - this.from) * share;
  }

  /** True while the picture still moves towards the newest step. */
  moving(nowMs: number): boolean {
    return this.to >= 0 && nowMs - this.startMs < this.spanMs && this.from !== this.to;
  }

  reset(): void {
    this.from = -1;
    this.to = -1;
    this.lastArrivalMs = -1;
  }
}
