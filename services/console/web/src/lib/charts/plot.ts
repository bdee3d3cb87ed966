// A chart of lines over time: uPlot with the look of the page. Where its numbers come from is its owner's business.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';

/** Times, then a column of values for each line; null: a gap. */
export type Columns = [number[], ...(number | null)[][]];

export interface Line {
  readonly label: string;
  readonly stroke: string;
  readonly dash?: number[];
  readonly width?: number;
  /** Holds each value until the next one. */
  readonly steps?: boolean;
}

/** A thin line from top to bottom. */
export interface Mark {
  readonly at: number;
  readonly colour: string;
}

export interface PlotOptions {
  readonly height: number;
  readonly timeLabel: string;
  /** Beside the axes; absent: none. */
  readonly xLabel?: string;
  readonly yLabel?: string;
  /** The y axis begins at 0; otherwise where the lines do. */
  readonly fromZero?: boolean;
  readonly lines: readonly Line[];
  readonly ink: string; // of the axes
  readonly grid: string;
  readonly marks: () => readonly Mark[];
  /** Charts of one group have a common crosshair. */
  readonly group: string;
}

/** Before the first sample there is no value at all. */
const textOf = (text: (value: number) => string) => (_: uPlot, value: number | null | undefined) =>
  value == null ? '–' : text(value);
const valueText = textOf((value) => String(Math.round(value * 1000) / 1000));

const stepped = uPlot.paths.stepped!({ align: 1 });
const fromZeroTo = (_: uPlot, __: number, max: number): uPlot.Range.MinMax => [0, Math.max(max ?? 0, 1e-3) * 1.08];
const around = (_: uPlot, min: number, max: number): uPlot.Range.MinMax => {
  const room = Math.max((max - min) * 0.04, 1e-3);
  return [min - room, max + room];
};
const labelled = (label: string | undefined) =>
  label === undefined ? {} : { label, labelSize: 18, labelFont: '12px system-ui' };

/** Fills the width of `box`. Dragging zooms in, a double click shows all again, the names of the lines hide and show them. */
export class Plot {
  private readonly plot: uPlot;
  private readonly sizes: ResizeObserver;

  constructor(box: HTMLElement, options: PlotOptions, columns: Columns) {
    const { height, xLabel, yLabel, fromZero = true, lines, ink, grid, marks } = options;
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { show: false }, font: '11px system-ui' };
    this.plot = new uPlot(
      {
        width: box.clientWidth,
        height,
        // Never a flat line in the middle of nowhere.
        scales: { x: { time: false }, y: { range: fromZero ? fromZeroTo : around } },
        cursor: { sync: { key: options.group } },
        legend: { live: true },
        axes: [
          { ...axis, ...labelled(xLabel), size: 22 },
          { ...axis, ...labelled(yLabel), size: 42 },
        ],
        series: [
          { label: options.timeLabel, value: textOf((time) => time.toFixed(1)) },
          ...lines.map(({ label, stroke, dash, width = 1.5, steps = false }) => ({
            label,
            stroke,
            dash,
            width,
            paths: steps ? stepped : undefined,
            points: { show: false },
            value: valueText,
          })),
        ],
        hooks: { drawAxes: [(u) => drawMarks(u, marks())] },
      },
      columns,
      box,
    );
    // By keyboard too.
    for (const name of box.querySelectorAll<HTMLElement>('.u-legend .u-series:not(:first-child) th')) {
      name.tabIndex = 0;
      name.onkeydown = (event) => {
        if (event.key === 'Enter') name.click();
      };
    }
    this.sizes = new ResizeObserver(() => this.plot.setSize({ width: box.clientWidth, height }));
    this.sizes.observe(box);
  }

  /** New values; while the user has zoomed in they leave the picture alone. */
  show(columns: Columns): void {
    this.plot.setData(columns, !this.zoomed());
    // Without a crosshair the legend shows the newest values.
    const newest = this.plot.data[0].length - 1;
    if (newest >= 0 && this.plot.cursor.idx == null) this.plot.setLegend({ idx: newest });
  }

  /** What the mouse does, by keyboard: arrows move the crosshair, + and - zoom there, Home shows all. False: not a key of these. */
  key(key: string): boolean {
    const { plot } = this;
    const { left: edge, top, width } = plot.over.getBoundingClientRect();
    const left = plot.cursor.left ?? -1;
    const at = left >= 0 ? left : width;
    const by = key === 'ArrowLeft' ? -1 : key === 'ArrowRight' ? 1 : 0;
    if (by !== 0) {
      // As the mouse: so the other charts of the group follow.
      const to = Math.min(width - 1, Math.max(0, at + (by * width) / 40));
      plot.over.dispatchEvent(new MouseEvent('mousemove', { clientX: edge + to, clientY: top + 10 }));
    } else if (key === '+' || key === '=') this.zoom(at / width, 0.5);
    else if (key === '-') this.zoom(at / width, 2);
    else if (key === 'Home') plot.setData(plot.data, true);
    else return false;
    return true;
  }

  private zoom(share: number, factor: number): void {
    const { data, scales } = this.plot;
    const { min, max } = scales.x;
    if (min == null || max == null || data[0].length < 2) return;
    const held = min + (max - min) * share;
    const first = data[0][0];
    const last = data[0][data[0].length - 1];
    const from = Math.max(first, held - (held - min) * factor);
    const to = Math.min(last, held + (max - held) * factor);
    if (to > from) this.plot.setScale('x', { min: from, max: to });
  }

  destroy(): void {
    this.sizes.disconnect();
    this.plot.destroy();
  }

  private zoomed(): boolean {
    const times = this.plot.data[0];
    const { min, max } = this.plot.scales.x;
    if (times.length < 2 || min == null || max == null) return false;
    return min > times[0] || max < times[times.length - 1];
  }
}

function drawMarks(u: uPlot, marks: readonly Mark[]): void {
  for (const { at, colour } of marks) {
    const x = Math.round(u.valToPos(at, 'x', true));
    if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) continue;
    u.ctx.fillStyle = colour;
    u.ctx.fillRect(x, u.bbox.top, 1, u.bbox.height);
  }
}
