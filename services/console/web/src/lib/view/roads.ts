// The layer that stands still: asphalt, markings, stop lines, names of the lanes.
import type { Camera } from './camera';
import type { Palette } from './palette';
import type { Path, Place } from './path';

export interface RoadLook {
  laneWidthM: number;
  palette: Palette;
}

type Context = CanvasRenderingContext2D;

export function drawRoads(context: Context, camera: Camera, paths: readonly Path[], look: RoadLook): void {
  const { palette } = look;
  context.fillStyle = palette.ground;
  context.fillRect(0, 0, camera.size.width, camera.size.height);
  if (paths.length === 0) return;
  context.lineJoin = 'round';
  drawAsphalt(context, camera, paths, look);
  for (const path of paths) drawCrossing(context, camera, path, look);
  drawSeparators(context, camera, paths, look);
  for (const path of paths) {
    drawStopLine(context, camera, path, look);
    if (camera.scale > 2) drawArrow(context, camera, path, palette);
  }
  drawNames(context, camera, paths, look);
}

function trace(context: Context, camera: Camera, places: readonly Place[]): void {
  context.beginPath();
  places.forEach((p, i) => {
    const x = camera.toScreenX(p.xM);
    const y = camera.toScreenY(p.yM);
    if (i === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
}

function drawAsphalt(context: Context, camera: Camera, paths: readonly Path[], look: RoadLook): void {
  context.strokeStyle = look.palette.asphalt;
  context.fillStyle = look.palette.asphalt;
  context.lineCap = 'butt';
  context.lineWidth = (look.laneWidthM + 0.3) * camera.scale;
  for (const path of paths) {
    trace(context, camera, path.stretch(0, path.lengthM));
    context.stroke();
  }
  // The junction itself: from stop line to stop line, with corners rounded by the kerb.
  const { edge, half } = junction(paths, look.laneWidthM);
  const corner = (sx: number, sy: number): Place[] => [
    { xM: sx * edge, yM: sy * half },
    { xM: sx * half, yM: sy * half },
    { xM: sx * half, yM: sy * edge },
  ];
  const at = (p: Place): [number, number] => [camera.toScreenX(p.xM), camera.toScreenY(p.yM)];
  context.beginPath();
  for (const [i, [sx, sy]] of [
    [1, 1],
    [-1, 1],
    [-1, -1],
    [1, -1],
  ].entries()) {
    const [a, b, c] = i % 2 === 0 ? corner(sx, sy) : corner(sx, sy).reverse();
    if (i === 0) context.moveTo(...at(a));
    else context.lineTo(...at(a));
    context.quadraticCurveTo(...at(b), ...at(c));
  }
  context.closePath();
  context.fill();
}

/** Distance of the stop lines from the centre and half the width of a road. */
function junction(paths: readonly Path[], laneWidthM: number): { edge: number; half: number } {
  let edge = 0;
  let half = 0;
  for (const path of paths) {
    const p = path.place(path.stopLineM);
    edge = Math.max(edge, Math.abs(p.xM), Math.abs(p.yM));
    half = Math.max(half, Math.min(Math.abs(p.xM), Math.abs(p.yM)) + laneWidthM / 2);
  }
  return { edge, half };
}

/** A point `along` metres beyond `distanceM` of the path's straight approach and `left` metres to its left. */
function beside(path: Path, distanceM: number, leftM: number): Place {
  const p = path.place(Math.min(distanceM, path.stopLineM));
  const d = path.direction(Math.min(distanceM, path.stopLineM - 0.1));
  const beyondM = Math.max(0, distanceM - path.stopLineM);
  return { xM: p.xM + d.xM * beyondM - d.yM * leftM, yM: p.yM + d.yM * beyondM + d.xM * leftM };
}

function drawCrossing(context: Context, camera: Camera, path: Path, look: RoadLook): void {
  if (camera.scale < 1.5) return;
  context.strokeStyle = look.palette.crossing;
  context.lineWidth = 0.55 * camera.scale;
  const half = look.laneWidthM / 2;
  // Both sides of the road: this lane and the one that mirrors it beyond the centre line.
  const lateral = lateralM(path);
  for (const shift of [0, 2 * lateral]) {
    for (let left = -half + 0.58; left < half; left += 1.17) {
      trace(context, camera, [
        beside(path, path.stopLineM + 1.2, left + shift),
        beside(path, path.stopLineM + 4.2, left + shift),
      ]);
      context.stroke();
    }
  }
}

/** Distance of a lane's centre from the centre line of its road. */
function lateralM(path: Path): number {
  const p = path.place(path.stopLineM);
  return Math.min(Math.abs(p.xM), Math.abs(p.yM));
}

function drawSeparators(context: Context, camera: Camera, paths: readonly Path[], look: RoadLook): void {
  const half = look.laneWidthM / 2;
  const width = Math.max(0.6, 0.15 * camera.scale);
  const { edge } = junction(paths, look.laneWidthM);
  for (const path of paths) {
    const lateral = lateralM(path);
    const innermost = lateral < look.laneWidthM;
    const exitM = Math.min(path.stopLineM, path.lengthM - path.stopLineM - 2 * edge);
    const line = (left: number, fromM: number, toM: number) => {
      trace(context, camera, [beside(path, fromM, left), beside(path, toM, left)]);
      context.stroke();
    };
    const solidFromM = path.stopLineM - 30;
    context.lineWidth = width;
    if (innermost) {
      context.strokeStyle = look.palette.centreLine;
      context.setLineDash([]);
      line(half + 0.2, 0, path.stopLineM);
      line(half - 0.2, 0, path.stopLineM);
      continue;
    }
    if (camera.scale < 1) continue;
    context.strokeStyle = look.palette.marking;
    const dash = [3 * camera.scale, 4.5 * camera.scale];
    // Towards the junction, and on the other side of the road, where cars leave it.
    context.setLineDash(dash);
    line(half, 0, solidFromM);
    line(2 * lateral - half, path.stopLineM - exitM, path.stopLineM);
    context.setLineDash([]);
    line(half, solidFromM, path.stopLineM);
  }
}

function drawStopLine(context: Context, camera: Camera, path: Path, look: RoadLook): void {
  const half = look.laneWidthM / 2;
  context.strokeStyle = look.palette.marking;
  context.lineWidth = Math.max(1, 0.4 * camera.scale);
  trace(context, camera, [beside(path, path.stopLineM + 0.2, -half), beside(path, path.stopLineM + 0.2, half)]);
  context.stroke();
}

/** The turn that a lane makes: 1 to the left, -1 to the right, 0 straight on. */
function turnOf(path: Path): number {
  const a = path.direction(path.stopLineM - 1);
  const b = path.direction(path.lengthM - 1);
  const cross = a.xM * b.yM - a.yM * b.xM;
  return cross > 0.5 ? 1 : cross < -0.5 ? -1 : 0;
}

function drawArrow(context: Context, camera: Camera, path: Path, palette: Palette): void {
  const turn = turnOf(path);
  const base = path.stopLineM - 14;
  const shape = (points: [number, number][]) => {
    trace(
      context,
      camera,
      points.map(([along, left]) => beside(path, base + along, left)),
    );
  };
  context.strokeStyle = palette.marking;
  context.fillStyle = palette.marking;
  context.lineJoin = 'miter';
  context.lineWidth = 0.24 * camera.scale;
  if (turn === 0) {
    shape([
      [0, 0],
      [4.2, 0],
    ]);
    context.stroke();
    shape([
      [4, -0.55],
      [6, 0],
      [4, 0.55],
    ]);
  } else {
    const side = turn > 0 ? 1 : -1;
    shape([
      [0, -0.45 * side],
      [3.6, -0.45 * side],
      [4.6, 0.25 * side],
    ]);
    context.stroke();
    shape([
      [5.25, -0.35 * side],
      [5.3, 1.15 * side],
      [3.75, 0.75 * side],
    ]);
  }
  context.fill();
}

function drawNames(context: Context, camera: Camera, paths: readonly Path[], look: RoadLook): void {
  if (camera.scale < 3.5) return;
  context.fillStyle = look.palette.label;
  context.font = `600 ${Math.min(14, 2.1 * camera.scale)}px system-ui, sans-serif`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const path of paths) {
    const p = beside(path, path.stopLineM - 20, 0);
    context.fillText(path.name, camera.toScreenX(p.xM), camera.toScreenY(p.yM));
  }
}
