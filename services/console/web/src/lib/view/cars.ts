// Cars: true length and width, turned along their path. With an on-board unit: a bright mark on the roof.
import type { Scene } from '../wire/scene';
import { ADVICE_IN_FORCE, HEARD, NOT_SENT, NOTHING_MISSED } from '../wire/scene';
import type { Camera } from './camera';
import { carColour, type Colouring } from './colouring';
import type { Moment } from './interpolation';
import type { Palette } from './palette';
import type { Path } from './path';

export interface CarLook {
  lengthM: number;
  widthM: number;
  speedLimitMps: number;
  stepS: number;
  palette: Palette;
  colouring: Colouring;
  selected: number | null;
  radio: boolean; // draw who hears and who missed a word
}

/** Harder than this the brake lights are on [m/s2]; also while a car stands. */
const BRAKE_LIGHTS_MPS2 = -0.4;
const STANDS_MPS = 0.15;
/** Narrower than this a car is a mark without details. */
const LEAST_WIDTH_PX = 2.6;

const front = { xM: 0, yM: 0 };
const rear = { xM: 0, yM: 0 };

/** Draws every car of the moment that is in sight; gives their number. */
export function drawCars(
  context: CanvasRenderingContext2D,
  camera: Camera,
  paths: readonly Path[],
  moment: Moment,
  look: CarLook,
): number {
  const { scene } = moment;
  let drawn = 0;
  for (let i = 0; i < scene.vehicle.length; ++i) {
    const path = paths[scene.lane[i]];
    if (path === undefined) continue;
    const at = moment.positionM[i];
    path.at(at, front);
    path.at(at - look.lengthM, rear);
    const x = camera.toScreenX(front.xM);
    const y = camera.toScreenY(front.yM);
    const margin = look.lengthM * camera.scale + 20;
    if (x < -margin || y < -margin || x > camera.size.width + margin || y > camera.size.height + margin) continue;
    const heading = Math.atan2(-(front.yM - rear.yM), front.xM - rear.xM);
    const cos = Math.cos(heading) * camera.scale;
    const sin = Math.sin(heading) * camera.scale;
    context.save();
    context.transform(cos, sin, -sin, cos, x, y);
    drawCar(context, camera.scale, scene, i, look);
    context.restore();
    ++drawn;
  }
  return drawn;
}

/** In the car's own frame: metres, front at the origin, looking along +x. */
function drawCar(context: CanvasRenderingContext2D, scale: number, scene: Scene, i: number, look: CarLook): void {
  const { lengthM, widthM, palette } = look;
  const half = widthM / 2;
  // Far away a car must still be seen: a mark of a few pixels around its middle.
  if (widthM * scale < LEAST_WIDTH_PX) {
    const width = LEAST_WIDTH_PX / scale;
    const length = Math.max(lengthM, (1.6 * LEAST_WIDTH_PX) / scale);
    context.fillStyle = carColour(scene, i, look.colouring, palette, look.speedLimitMps);
    context.fillRect(-(lengthM + length) / 2, -width / 2, length, width);
    if (look.radio && scene.equipped[i]) drawDownlink(context, scale, scene, i, look);
    if (look.radio && scene.uplink[i] !== HEARD) drawUplink(context, scale, scene, i, look);
    if (scene.vehicle[i] === look.selected) ring(context, scale, look, palette.selected);
    return;
  }
  context.fillStyle = carColour(scene, i, look.colouring, palette, look.speedLimitMps);
  context.beginPath();
  context.roundRect(-lengthM, -half, lengthM, widthM, [0.35, 0.75, 0.75, 0.35]);
  context.fill();
  if (scale > 2.5) {
    context.fillStyle = palette.glass;
    context.fillRect(-lengthM * 0.36, -half * 0.78, 0.5, widthM * 0.78);
    context.fillRect(-lengthM * 0.86, -half * 0.72, 0.3, widthM * 0.72);
  }
  if (scene.equipped[i]) {
    context.fillStyle = palette.roofMark;
    context.beginPath();
    context.arc(-lengthM * 0.58, 0, 0.5, 0, 2 * Math.PI);
    context.fill();
  }
  if (scene.accelerationMps2[i] < BRAKE_LIGHTS_MPS2 || scene.speedMps[i] < STANDS_MPS) {
    context.fillStyle = palette.outline;
    context.fillRect(-lengthM - 0.12, -half, 0.55, 0.66);
    context.fillRect(-lengthM - 0.12, half - 0.66, 0.55, 0.66);
    context.fillStyle = palette.brake;
    context.fillRect(-lengthM - 0.05, -half + 0.06, 0.4, 0.54);
    context.fillRect(-lengthM - 0.05, half - 0.6, 0.4, 0.54);
  }
  if (scene.guidance[i] === ADVICE_IN_FORCE) drawAdvice(context, scene.commandedMps2[i], look);
  if (look.radio && scene.equipped[i]) drawDownlink(context, scale, scene, i, look);
  if (look.radio) drawUplink(context, scale, scene, i, look);
  if (scene.vehicle[i] === look.selected) ring(context, scale, look, palette.selected);
}

/** The acceleration that is asked for: a bar along the car's left side from its middle, forward or backward, 1 m per m/s2. */
function drawAdvice(context: CanvasRenderingContext2D, commandedMps2: number, look: CarLook): void {
  const side = -look.widthM / 2 - 0.42;
  const middle = -look.lengthM / 2;
  context.fillStyle = look.palette.advice;
  context.fillRect(middle - 0.14, side - 0.14, 0.28, 0.4);
  if (!Number.isFinite(commandedMps2)) return;
  const reach = Math.max(-3, Math.min(3, commandedMps2));
  context.fillRect(Math.min(middle, middle + reach), side, Math.abs(reach), 0.26);
}

/** What came from the RSU: a ring around a car that has just heard advice, a cross over one that missed the newest word. */
function drawDownlink(context: CanvasRenderingContext2D, scale: number, scene: Scene, i: number, look: CarLook): void {
  const missed = scene.missed[i] !== NOTHING_MISSED;
  const fresh = scene.adviceAge[i] >= 0 && scene.adviceAge[i] <= 1;
  if (!missed && !fresh) return;
  const middle = -look.lengthM / 2;
  context.lineWidth = Math.max(0.25, 1.3 / scale);
  context.strokeStyle = missed ? look.palette.lost : look.palette.advice;
  context.beginPath();
  if (missed) {
    const arm = Math.max(1.3, 3 / scale);
    for (const side of [-1, 1]) {
      context.moveTo(middle - arm, -arm * side);
      context.lineTo(middle + arm, arm * side);
    }
  } else {
    context.arc(middle, 0, Math.max(look.lengthM * 0.62, 4 / scale), 0, 2 * Math.PI);
  }
  context.stroke();
}

/**
 * What went to the RSU: a wedge on the right side, out of the car. Full: the newest message was heard. Hollow and struck
 * through: it was lost.
 */
function drawUplink(context: CanvasRenderingContext2D, scale: number, scene: Scene, i: number, look: CarLook): void {
  const fate = scene.uplink[i];
  if (fate === NOT_SENT) return;
  const half = Math.max(0.75, 3.2 / scale);
  const foot = look.widthM / 2 + Math.max(0.12, 0.8 / scale);
  const middle = -look.lengthM / 2;
  context.beginPath();
  context.moveTo(middle - half, foot);
  context.lineTo(middle + half, foot);
  context.lineTo(middle, foot + 1.5 * half);
  context.closePath();
  if (fate === HEARD) {
    context.fillStyle = look.palette.advice;
    context.fill();
    return;
  }
  context.moveTo(middle - 1.5 * half, foot + 1.5 * half);
  context.lineTo(middle + 1.5 * half, foot - 0.3 * half);
  context.lineWidth = Math.max(0.22, 1.4 / scale);
  context.strokeStyle = look.palette.lost;
  context.stroke();
}

function ring(context: CanvasRenderingContext2D, scale: number, look: CarLook, colour: string): void {
  context.strokeStyle = colour;
  context.lineWidth = 2 / scale;
  const gap = 4 / scale;
  context.strokeRect(-look.lengthM - gap, -look.widthM / 2 - gap, look.lengthM + 2 * gap, look.widthM + 2 * gap);
}

/** The car at a place of the screen, or null; `slackPx` around it counts too. */
export function carAt(
  camera: Camera,
  paths: readonly Path[],
  moment: Moment,
  lengthM: number,
  px: number,
  py: number,
  slackPx = 8,
): number | null {
  let best: number | null = null;
  let bestPx = Math.max(slackPx, (lengthM / 2) * camera.scale);
  for (let i = 0; i < moment.scene.vehicle.length; ++i) {
    const path = paths[moment.scene.lane[i]];
    if (path === undefined) continue;
    path.at(moment.positionM[i] - lengthM / 2, front);
    const distance = Math.hypot(camera.toScreenX(front.xM) - px, camera.toScreenY(front.yM) - py);
    if (distance < bestPx) {
      bestPx = distance;
      best = moment.scene.vehicle[i];
    }
  }
  return best;
}
