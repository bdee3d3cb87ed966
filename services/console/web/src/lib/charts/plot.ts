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
}

/** A thin line from top to bottom. */
export interface Mark {
  readonly at: number;
  readonly colour: string;
}

export interface PlotOptions {
  readonly height: number;
  readonly timeLabel: string;
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

/** Fills the width of `box`. Dragging zooms in, a double click shows all again, the names of the lines hide and show them. */
export class Plot {
  private readonly plot: uPlot;
  private readonly sizes: ResizeObserver;

  constructor(box: HTMLElement, options: PlotOptions, columns: Columns) {
    const { height, lines, ink, grid, marks } = options;
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { show: false }, font: '11px system-ui' };
    this.plot = new uPlot(
      {
        width: box.clientWidth,
        height,
        // From zero, and never a flat line in the middle of nowhere.
        scales: { x: { time: false }, y: { range: (_, __, max) => [0, Math.max(max ?? 0, 1e-3) * 1.08] } },
        cursor: { sync: { key: options.group } },
        legend: { live: true },
        axes: [
          { ...axis, size: 22 },
          { ...axis, size: 42 },
        ],
        series: [
          { label: options.timeLabel, value: textOf((time) => time.toFixed(1)) },
          ...lines.map(({ label, stroke, dash, width = 1.5 }) => ({
            label,
            stroke,
            dash,
            width,
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
