// What `lukou report` puts into the page for its charts.
import { aligned } from '../lib/charts/aligned';
import type { Columns, Line, Mark } from '../lib/charts/plot';
import type { Language } from '../lib/i18n/words.svelte';

export type Text = Readonly<Record<Language, string>>;

export interface ChartLine {
  readonly name: Text;
  readonly colour: string;
  readonly dash: number[];
  readonly steps: boolean;
  readonly x: number[];
  readonly y: (number | null)[];
}

export interface ChartMark {
  readonly name: Text;
  readonly at: number;
  readonly colour: string;
}

export interface Chart {
  readonly title: Text;
  readonly subtitle: Text;
  readonly x: Text;
  readonly y: Text;
  readonly xMin: number | null;
  readonly xMax: number | null;
  readonly yMin: number | null;
  readonly lines: readonly ChartLine[];
  readonly marks: readonly ChartMark[];
}

export interface ReportData {
  readonly title: Text;
  /** By the name of the figure, a chart for each of its panels. */
  readonly charts: Readonly<Record<string, readonly Chart[]>>;
}

export const columnsOf = (chart: Chart): Columns => aligned(chart.lines);

export const linesOf = (chart: Chart, language: Language): Line[] =>
  chart.lines.map(({ name, colour, dash, steps }) => ({
    label: name[language],
    stroke: colour,
    dash: dash.length > 0 ? dash : undefined,
    steps,
  }));

export const marksOf = (chart: Chart): Mark[] => chart.marks.map(({ at, colour }) => ({ at, colour }));

/** Names of the marks that have one, for a line below the chart. */
export const markNames = (chart: Chart, language: Language): string[] =>
  chart.marks.map(({ name }) => name[language]).filter((name) => name !== '');
