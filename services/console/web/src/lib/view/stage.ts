// The two canvases of the picture: the roads, drawn when the camera or the theme changes, and what moves, drawn when it moved.
import type { Console } from '../run/console.svelte';
import { rangeOf } from '../run/fields';
import { drawCars } from './cars';
import { drawHeads } from './heads';
import { momentBetween, type Moment } from './interpolation';
import { PALETTES, type Palette, type Theme } from './palette';
import type { Place } from './path';
import { drawAntennas, drawWay } from './radio';
import { drawRoads } from './roads';
import type { ViewState } from './view_state.svelte';

/** How often the parts of the page beside the picture hear what it shows [ms]. */
const TELL_MS = 150;

export class Stage {
  moment: Moment | null = null;
  carsDrawn = 0;
  private readonly roads: CanvasRenderingContext2D;
  private readonly moving: CanvasRenderingContext2D;
  private ratio = 1;
  private roadsKey = '';
  private movingKey = '';
  private toldMs = 0;
  private frames = 0;

  constructor(
    private readonly roadCanvas: HTMLCanvasElement,
    private readonly movingCanvas: HTMLCanvasElement,
    private readonly run: Console,
    private readonly view: ViewState,
  ) {
    this.roads = roadCanvas.getContext('2d', { alpha: false })!;
    this.moving = movingCanvas.getContext('2d')!;
  }

  resize(width: number, height: number): void {
    this.ratio = window.devicePixelRatio || 1;
    for (const canvas of [this.roadCanvas, this.movingCanvas]) {
      canvas.width = Math.max(1, Math.round(width * this.ratio));
      canvas.height = Math.max(1, Math.round(height * this.ratio));
    }
    this.view.resize(width, height);
    this.roadsKey = '';
    this.movingKey = '';
  }

  /** Draws the frame of `nowMs` if anything has changed. */
  draw(nowMs: number, theme: Theme): void {
    const { run, view } = this;
    this.moment = this.momentAt(nowMs);
    this.follow();
    const palette = PALETTES[theme];
    const still = [view.cameraMoves, theme, run.hello?.run, run.paths.length].join();
    if (still !== this.roadsKey) {
      this.roadsKey = still;
      this.roads.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
      drawRoads(this.roads, view.camera, run.paths, { laneWidthM: run.hello?.laneWidthM ?? 3.5, palette });
    }
    const shownStep = this.moment === null ? -1 : (run.scrubbed ?? run.playback.stepAt(nowMs));
    const key = [still, shownStep, this.moment?.scene.step, view.colouring, view.radio, view.selected].join();
    if (key !== this.movingKey) {
      this.movingKey = key;
      this.drawMoving(palette);
    }
    run.drawn();
    this.tell(nowMs);
  }

  private momentAt(nowMs: number): Moment | null {
    const { scenes, scrubbed, playback, stepS } = this.run;
    const step = scrubbed ?? playback.stepAt(nowMs);
    if (scenes.length === 0) return null;
    const index = Math.max(0, scenes.indexAt(step));
    const before = scenes.at(index);
    if (before === null) return null;
    return momentBetween(before, scrubbed === null ? scenes.at(index + 1) : null, step, stepS);
  }

  private follow(): void {
    const { view, moment } = this;
    if (!view.following || view.selected === null || moment === null) return;
    const i = moment.scene.vehicle.indexOf(view.selected);
    if (i < 0) return;
    const place = this.middleOf(moment.scene.lane[i], moment.positionM[i]);
    if (place !== undefined) view.centreOn(place.xM, place.yM);
  }

  private drawMoving(palette: Palette): void {
    const { moving, run, view, moment } = this;
    const { hello } = run;
    moving.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    moving.clearRect(0, 0, view.camera.size.width, view.camera.size.height);
    if (moment === null || hello === null) return;
    if (view.radio) this.drawRadio(palette, moment);
    this.carsDrawn = drawCars(moving, view.camera, run.paths, moment, {
      lengthM: hello.vehicleLengthM,
      widthM: hello.vehicleWidthM,
      speedLimitMps: hello.speedLimitMps,
      stepS: run.stepS,
      palette,
      colouring: view.colouring,
      selected: view.selected,
      radio: view.radio,
    });
    drawHeads(moving, view.camera, run.paths, moment.scene, {
      laneWidthM: hello.laneWidthM,
      stepS: run.stepS,
      palette,
    });
    this.movingCanvas.dataset.cars = String(this.carsDrawn);
    this.movingCanvas.dataset.step = String(moment.scene.step);
    this.movingCanvas.dataset.frames = String(++this.frames);
  }

  /** Behind the cars. */
  private drawRadio(palette: Palette, { scene, positionM }: Moment): void {
    const { moving, run, view } = this;
    const look = { antennas: run.hello?.antennas ?? [], rangeM: rangeOf(run.fields), palette };
    drawAntennas(moving, view.camera, look);
    const i = view.selected === null ? -1 : scene.vehicle.indexOf(view.selected);
    if (i < 0) return;
    const place = this.middleOf(scene.lane[i], positionM[i]);
    if (place !== undefined) drawWay(moving, view.camera, look, place, scene.uplink[i]);
  }

  /** Where the middle of a car is whose front is at `positionM` of its lane. */
  private middleOf(lane: number, positionM: number): Place | undefined {
    return this.run.paths[lane]?.place(positionM - (this.run.hello?.vehicleLengthM ?? 0) / 2);
  }

  private tell(nowMs: number): void {
    const scene = this.moment?.scene ?? null;
    if (scene === this.view.shown || nowMs - this.toldMs < TELL_MS) return;
    this.toldMs = nowMs;
    this.view.shown = scene;
  }
}
