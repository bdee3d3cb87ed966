// Signal heads: a bar on the stop line and, seen from near, a lamp behind it with the seconds to its next change.
// The lamp's shape says what its colour says: red square, yellow diamond, green disc.
import { GREEN, RED, YELLOW, type Scene } from '../wire/scene';
import type { Camera } from './camera';
import type { Palette } from './palette';
import type { Path } from './path';

export interface HeadPlace {
  lane: number;
  x: number;
  y: number;
  radius: number;
}

export function aspectColour(aspect: number, palette: Palette): string {
  if (aspect === GREEN) return palette.green;
  if (aspect === YELLOW) return palette.yellow;
  return aspect === RED ? palette.red : palette.unknown;
}

/** Where the heads are on the screen. */
export function headPlaces(camera: Camera, paths: readonly Path[], laneWidthM: number): HeadPlace[] {
  const radius = Math.min(14, Math.max(3.5, (laneWidthM / 2) * camera.scale * 0.9));
  return paths.map((path, lane) => {
    const p = path.place(path.stopLineM);
    const d = path.direction(path.stopLineM - 0.1);
    const beyondM = 2.7;
    return {
      lane,
      x: camera.toScreenX(p.xM + d.xM * beyondM),
      y: camera.toScreenY(p.yM + d.yM * beyondM),
      radius,
    };
  });
}

export function drawHeads(
  context: CanvasRenderingContext2D,
  camera: Camera,
  paths: readonly Path[],
  scene: Scene,
  look: { laneWidthM: number; stepS: number; palette: Palette },
): void {
  const places = headPlaces(camera, paths, look.laneWidthM);
  const near = camera.scale > 2.2;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const { lane, x, y, radius } of places) {
    const path = paths[lane];
    const aspect = scene.heads[lane] ?? 0;
    const colour = aspectColour(aspect, look.palette);
    drawBar(context, camera, path, look.laneWidthM, colour);
    if (!near) continue;
    context.fillStyle = look.palette.head;
    context.beginPath();
    context.roundRect(x - radius - 0.5, y - radius - 0.5, 2 * radius + 1, 2 * radius + 1, 2);
    context.fill();
    context.fillStyle = colour;
    lamp(context, aspect, x, y, radius);
    const change = scene.changeIn[lane] ?? -1;
    if (change < 0 || radius < 5.2) continue;
    context.fillStyle = '#06090c';
    context.font = `700 ${Math.max(8, Math.round(radius * 1.05))}px system-ui, sans-serif`;
    context.fillText(String(Math.ceil(change * look.stepS)), x, y + 0.5);
  }
}

function drawBar(
  context: CanvasRenderingContext2D,
  camera: Camera,
  path: Path,
  laneWidthM: number,
  colour: string,
): void {
  const p = path.place(path.stopLineM);
  const d = path.direction(path.stopLineM - 0.1);
  const half = laneWidthM / 2 - 0.15;
  context.strokeStyle = colour;
  context.lineCap = 'butt';
  context.lineWidth = Math.max(2.5, 0.7 * camera.scale);
  context.beginPath();
  context.moveTo(camera.toScreenX(p.xM - d.yM * half), camera.toScreenY(p.yM + d.xM * half));
  context.lineTo(camera.toScreenX(p.xM + d.yM * half), camera.toScreenY(p.yM - d.xM * half));
  context.stroke();
}

function lamp(context: CanvasRenderingContext2D, aspect: number, x: number, y: number, radius: number): void {
  context.beginPath();
  if (aspect === GREEN) {
    context.arc(x, y, radius, 0, 2 * Math.PI);
  } else if (aspect === YELLOW) {
    context.moveTo(x, y - radius);
    context.lineTo(x + radius, y);
    context.lineTo(x, y + radius);
    context.lineTo(x - radius, y);
  } else {
    const half = radius - 1;
    context.rect(x - half, y - half, 2 * half, 2 * half);
  }
  context.fill();
}
