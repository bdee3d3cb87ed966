// The radio layer beside the cars: the RSUs' antennas, how far they are heard, and the way of the chosen car's messages.
import { HEARD, NOT_SENT } from '../wire/scene';
import type { Camera } from './camera';
import type { Palette } from './palette';
import type { Place } from './path';

export interface RadioLook {
  antennas: readonly Place[];
  rangeM: number | null;
  palette: Palette;
}

export function drawAntennas(context: CanvasRenderingContext2D, camera: Camera, look: RadioLook): void {
  context.strokeStyle = look.palette.advice;
  context.fillStyle = look.palette.advice;
  for (const antenna of look.antennas) {
    const x = camera.toScreenX(antenna.xM);
    const y = camera.toScreenY(antenna.yM);
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y + 9);
    context.lineTo(x, y);
    context.stroke();
    context.beginPath();
    context.arc(x, y, 3.5, 0, 2 * Math.PI);
    context.fill();
    for (const radius of [8, 13]) {
      context.beginPath();
      context.arc(x, y, radius, -2.4, -0.75);
      context.stroke();
    }
    if (look.rangeM === null) continue;
    context.setLineDash([8, 6]);
    context.beginPath();
    context.arc(x, y, look.rangeM * camera.scale, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
  }
}

/** The way of a car's newest message to the nearest antenna: whole if it was heard; dashed and crossed if it was lost. */
export function drawWay(
  context: CanvasRenderingContext2D,
  camera: Camera,
  look: RadioLook,
  from: Place,
  fate: number,
): void {
  const away = ({ xM, yM }: Place) => Math.hypot(xM - from.xM, yM - from.yM);
  const antenna = [...look.antennas].sort((a, b) => away(a) - away(b))[0];
  if (antenna === undefined || fate === NOT_SENT) return;
  const x = [camera.toScreenX(from.xM), camera.toScreenX(antenna.xM)];
  const y = [camera.toScreenY(from.yM), camera.toScreenY(antenna.yM)];
  context.strokeStyle = fate === HEARD ? look.palette.advice : look.palette.lost;
  context.lineWidth = 1.6;
  context.setLineDash(fate === HEARD ? [] : [5, 5]);
  context.beginPath();
  context.moveTo(x[0], y[0]);
  context.lineTo(x[1], y[1]);
  context.stroke();
  context.setLineDash([]);
  if (fate === HEARD) return;
  const middle = [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2];
  context.lineWidth = 2.2;
  context.beginPath();
  for (const side of [-1, 1]) {
    context.moveTo(middle[0] - 5, middle[1] - 5 * side);
    context.lineTo(middle[0] + 5, middle[1] + 5 * side);
  }
  context.stroke();
}
