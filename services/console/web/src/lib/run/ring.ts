// A store of samples in the order of their steps that never outgrows its capacity: when it is full, every second sample of
// its older half goes. The newer half stays whole; the older a stretch, the coarser it is.

export interface Stepped {
  readonly step: number;
}

export class ThinningRing<T extends Stepped> {
  private items: T[] = [];

  constructor(private readonly capacity: number) {}

  get length(): number {
    return this.items.length;
  }

  get first(): T | null {
    return this.items[0] ?? null;
  }

  get last(): T | null {
    return this.items[this.items.length - 1] ?? null;
  }

  all(): readonly T[] {
    return this.items;
  }

  clear(): void {
    this.items = [];
  }

  /** A sample of an older step (a recording went back) drops all from that step on. */
  push(item: T): void {
    const last = this.last;
    if (last !== null && item.step <= last.step) this.items.length = this.indexAt(item.step - 1) + 1;
    this.items.push(item);
    if (this.items.length <= this.capacity) return;
    const older = this.items.length >> 1;
    this.items = this.items.filter((_, i) => i >= older || i % 2 === 0);
  }

  /** Index of the last sample at or before `step`; -1 if all are later. */
  indexAt(step: number): number {
    let low = 0;
    let high = this.items.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.items[middle].step <= step) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  at(index: number): T | null {
    return this.items[index] ?? null;
  }
}
