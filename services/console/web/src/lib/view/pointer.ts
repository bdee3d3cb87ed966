// Mouse, pen and fingers on the picture: drag moves, two fingers zoom, wheel zooms at the pointer, a tap chooses.

export interface Handlers {
  pan(dx: number, dy: number): void;
  zoomAt(x: number, y: number, factor: number): void;
  tap(x: number, y: number): void;
  reset(): void;
}

/** A pointer that moved less than this between down and up has tapped [px]. */
const TAP_PX = 5;

/** Listens on `element`; gives the function that stops it. */
export function listen(element: HTMLElement, handlers: Handlers): () => void {
  const pointers = new Map<number, { x: number; y: number }>();
  let travelledPx = 0;

  const placeOf = (event: PointerEvent | WheelEvent | MouseEvent) => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  const down = (event: PointerEvent) => {
    if (event.button !== 0) return;
    if (pointers.size === 0) travelledPx = 0;
    pointers.set(event.pointerId, placeOf(event));
    element.setPointerCapture(event.pointerId);
  };

  const move = (event: PointerEvent) => {
    const before = pointers.get(event.pointerId);
    if (before === undefined) return;
    const now = placeOf(event);
    travelledPx += Math.abs(now.x - before.x) + Math.abs(now.y - before.y);
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other !== undefined) {
      const was = Math.hypot(before.x - other.x, before.y - other.y);
      const is = Math.hypot(now.x - other.x, now.y - other.y);
      if (was > 0) handlers.zoomAt((now.x + other.x) / 2, (now.y + other.y) / 2, is / was);
    } else if (travelledPx > TAP_PX) {
      handlers.pan(now.x - before.x, now.y - before.y);
    }
    pointers.set(event.pointerId, now);
  };

  const up = (event: PointerEvent) => {
    const tapped = pointers.size === 1 && travelledPx <= TAP_PX && event.type === 'pointerup';
    if (!pointers.delete(event.pointerId) || !tapped) return;
    const at = placeOf(event);
    handlers.tap(at.x, at.y);
  };

  const wheel = (event: WheelEvent) => {
    event.preventDefault();
    const at = placeOf(event);
    const notches = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY / 3 : event.deltaY / 100;
    handlers.zoomAt(at.x, at.y, 1.2 ** -Math.max(-3, Math.min(3, notches)));
  };

  const twice = () => handlers.reset();

  element.addEventListener('pointerdown', down);
  element.addEventListener('pointermove', move);
  element.addEventListener('pointerup', up);
  element.addEventListener('pointercancel', up);
  element.addEventListener('wheel', wheel, { passive: false });
  element.addEventListener('dblclick', twice);
  return () => {
    element.removeEventListener('pointerdown', down);
    element.removeEventListener('pointermove', move);
    element.removeEventListener('pointerup', up);
    element.removeEventListener('pointercancel', up);
    element.removeEventListener('wheel', wheel);
    element.removeEventListener('dblclick', twice);
  };
}
