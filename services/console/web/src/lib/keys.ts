// The keyboard: what each key does, wherever the focus is, except where the user writes or moves something.
import type { Console } from './run/console.svelte';
import { neighbour } from './run/speed';
import { settings } from './settings.svelte';
import { TABS, type ViewState } from './view/view_state.svelte';

export interface Sights {
  near(): void;
  whole(): void;
}

/** True if the key belongs to what has the focus. */
function takenBy(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof Element)) return false;
  if (target.closest('dialog') !== null) return true;
  if (target.matches('textarea, select, input:not([type=range])')) return true;
  const acts = target.matches('button, summary, a, [role=checkbox]');
  return acts && (key === ' ' || key === 'Enter');
}

export function keyHandler(run: Console, view: ViewState, sights: Sights): (event: KeyboardEvent) => void {
  const ask = (text: string) => {
    if (run.mayAct && !run.over) void run.ask(text);
  };
  // Of a run everybody may look back; a recording goes to another step for all.
  const look = (by: number) => {
    if (run.recordedTo === null || run.mayAct) run.lookBy(by);
  };
  const actions: Record<string, () => void> = {
    ' ': () => ask(run.status?.phase === 'running' ? 'pause' : 'resume'),
    '.': () => (run.scrubbed === null && run.recordedTo === null ? ask('step 1') : look(1)),
    ',': () => look(-1),
    l: () => (run.scrubbed = null),
    '[': () => ask(`pace ${neighbour(run.status?.pace ?? 0, -1)}`),
    ']': () => ask(`pace ${neighbour(run.status?.pace ?? 0, 1)}`),
    '+': () => view.zoom(1.3),
    '=': () => view.zoom(1.3),
    '-': () => view.zoom(1 / 1.3),
    '0': () => sights.near(),
    '9': () => sights.whole(),
    n: () => view.selectNext(1),
    p: () => view.selectNext(-1),
    f: () => (view.following = view.selected !== null && !view.following),
    c: () => view.nextColouring(),
    r: () => (view.radio = !view.radio),
    t: () => settings.toggleTheme(),
    u: () => {
      if (run.maySet && run.undoable.length > 0) void run.undo();
    },
    '?': () => (view.helpOpen = true),
    Escape: () => view.select(null),
  };
  TABS.forEach((tab, i) => (actions[String(i + 1)] = () => (view.tab = tab)));

  return (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || takenBy(event.target, event.key)) return;
    const action = actions[event.key];
    if (action === undefined) return;
    event.preventDefault();
    action();
  };
}
