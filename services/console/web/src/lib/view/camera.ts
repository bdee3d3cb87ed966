// What part of the plane the picture shows. Screen: pixels of the page (not of the device), y downwards.
import type { Place } from './path';

export interface Size {
  width: number;
  height: number;
}

export const NEAREST = 40; // pixels per metre
export const FARTHEST = 0.1;

export class Camera {
  xM = 0;
  yM = 0;
  scale = 4; // pixels per metre
  size: Size = { width: 100, height: 100 };

  toScreenX(xM: number): number {
    return this.size.width / 2 + (xM - this.xM) * this.scale;
  }

  toScreenY(yM: number): number {
    return this.size.height / 2 - (yM - this.yM) * this.scale;
  }

  toPlane(px: number, py: number): Place {
    return {
      xM: this.xM + (px - this.size.width / 2) / this.scale,
      yM: this.yM - (py - this.size.height / 2) / this.scale,
    };
  }

  /** Shows the square of `reachM` metres around the centre of the junction, whole. */
  fit(reachM: number): void {
    this.xM = 0;
    this.yM = 0;
    this.scale = Math.min(this.size.width, this.size.height) / (2 * reachM);
  }

  /** Zooms by `factor`; the place under (px, py) stays where it is. */
  zoomAt(px: number, py: number, factor: number): void {
    const held = this.toPlane(px, py);
    this.scale = Math.min(NEAREST, Math.max(FARTHEST, this.scale * factor));
    this.xM = held.xM - (px - this.size.width / 2) / this.scale;
    this.yM = held.yM + (py - this.size.height / 2) / this.scale;
  }

  panBy(dx: number, dy: number): void {
    this.xM -= dx / this.scale;
    this.yM += dy / this.scale;
  }
}
