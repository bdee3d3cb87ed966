// What the user looks at, and how.
import { CROSSED, type Scene } from '../wire/scene';
import { Camera } from './camera';
import { COLOURINGS, type Colouring } from './colouring';
import type { Section, Sight } from './link';

export const TABS = ['figures', 'signals', 'log'] as const;
export type Tab = (typeof TABS)[number];

/** Metres of approach that the paper's window shows. */
export const NEAR_APPROACH_M = 50;
const MARGIN = 1.03;

export class ViewState {
  colouring = $state<Colouring>('equipped');
  radio = $state(false);
  selected = $state<number | null>(null);
  following = $state(false);
  tab = $state<Tab>('figures');
  planLane = $state<number | null>(null); // the lane whose head was chosen last
  planAsked = $state(0); // counts those choices
  helpOpen = $state(false);
  shown = $state.raw<Scene | null>(null); // follows what the picture shows, a few times a second

  readonly camera = new Camera();
  cameraMoves = $state(0); // counts moves of the camera
  private reachM = 70;
  private fitted = true;
  private linked: Section | null = null; // what a link says is in sight, until it can be shown

  select(vehicle: number | null): void {
    this.selected = vehicle;
    if (vehicle === null) this.following = false;
  }

  /** The car `by` places after the chosen one, among those that have not crossed their stop line. */
  selectNext(by: number): void {
    const scene = this.shown;
    if (scene === null) return;
    const vehicles = [...scene.vehicle].filter((_, i) => scene.state[i] !== CROSSED);
    if (vehicles.length === 0) return;
    const at = this.selected === null ? -1 : vehicles.indexOf(this.selected);
    const next = at < 0 && by < 0 ? vehicles.length - 1 : (at + by + vehicles.length) % vehicles.length;
    this.select(vehicles[next]);
  }

  /** What is in sight; of a picture that is moved or zoomed, its middle too. */
  section(): Section {
    if (this.fitted) return { reachM: this.reachM / MARGIN, centre: null };
    const { size, scale, xM, yM } = this.camera;
    return { reachM: Math.min(size.width, size.height) / (2 * scale * MARGIN), centre: { xM, yM } };
  }

  /** Takes over what a link says; what is in sight with the next showLinked(). */
  restore(sight: Partial<Sight>): void {
    if (sight.tab !== undefined) this.tab = sight.tab;
    if (sight.colouring !== undefined) this.colouring = sight.colouring;
    this.radio = sight.radio ?? this.radio;
    if (sight.car !== undefined) this.select(sight.car);
    this.following = sight.follow ?? this.following;
    if (sight.lane != null) this.choosePlan(sight.lane);
    this.linked = sight.section ?? null;
  }

  /** Shows what a link says is in sight, once; false if there is nothing to show. */
  showLinked(): boolean {
    if (this.linked === null) return false;
    const { reachM, centre } = this.linked;
    const { following } = this;
    this.linked = null;
    this.fit(reachM);
    if (centre !== null) this.centreOn(centre.xM, centre.yM);
    this.following = following;
    return true;
  }

  openPlan(lane: number): void {
    this.tab = 'signals';
    this.choosePlan(lane);
  }

  private choosePlan(lane: number): void {
    this.planLane = lane;
    ++this.planAsked;
  }

  nextColouring(): void {
    this.colouring = COLOURINGS[(COLOURINGS.indexOf(this.colouring) + 1) % COLOURINGS.length];
  }

  resize(width: number, height: number): void {
    this.camera.size = { width, height };
    if (this.fitted) this.camera.fit(this.reachM);
    ++this.cameraMoves;
  }

  /** Shows everything within `reachM` of the centre. */
  fit(reachM: number): void {
    this.reachM = reachM * MARGIN;
    this.fitted = true;
    this.following = false;
    this.camera.fit(this.reachM);
    ++this.cameraMoves;
  }

  zoomAt(px: number, py: number, factor: number): void {
    this.fitted = false;
    this.camera.zoomAt(px, py, factor);
    ++this.cameraMoves;
  }

  zoom(factor: number): void {
    this.zoomAt(this.camera.size.width / 2, this.camera.size.height / 2, factor);
  }

  panBy(dx: number, dy: number): void {
    this.fitted = false;
    this.following = false;
    this.camera.panBy(dx, dy);
    ++this.cameraMoves;
  }

  centreOn(xM: number, yM: number): void {
    if (this.camera.xM === xM && this.camera.yM === yM) return;
    this.fitted = false;
    this.camera.xM = xM;
    this.camera.yM = yM;
    ++this.cameraMoves;
  }
}
