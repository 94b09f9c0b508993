// SPDX-License-Identifier: GPL-3.0-or-later
// A figure: curves, points or bars that one can zoom, read, switch and take away as CSV.

import uPlot from "uplot";
import { download, el, printed } from "../dom";
import { colour, onTheme } from "../theme";
import { csvOf, described, joined, type ChartSpec, type Series, type Table } from "./chart_spec";
import { logarithmicTicks, signedTicks, tickLabels } from "./ticks";

let charts = 0;
/** Kinds of line that tell curves of one colour apart, and how the legend shows them. */
const dashes: { pattern: number[] | undefined; mark: string }[] = [
  { pattern: undefined, mark: "━━" }, { pattern: [7, 5], mark: "╌╌" }, { pattern: [2, 4], mark: "┈┈" }, { pattern: [11, 4, 2, 4], mark: "━╌" },
];

function dashOf(series: Series): { pattern: number[] | undefined; mark: string } {
  return dashes[(series.dash ?? (series.dashed ? 1 : 0)) % dashes.length]!;
}

export class Chart {
  readonly element: HTMLElement;
  private readonly host = el("div", { class: "plot", role: "img" });
  private readonly readout = el("p", { class: "readout", "aria-hidden": "true" });
  private readonly keys = el("div", { class: "keys" });
  private readonly caption = el("figcaption", {});
  private readonly title = el("h3", {});
  private readonly number = ++charts;
  private readonly hidden = new Set<string>();
  private readonly known = new Set<string>();
  private plot: uPlot | null = null;
  private width = 0;
  private logX: boolean;
  private logY: boolean;
  /** Of an axis that shows both signs logarithmically, the value below which it is linear; else null. */
  private threshold: number | null = null;

  /** @param pick told the series, and the place in it, of a point that was clicked. */
  constructor(private spec: ChartSpec, private readonly pick?: (series: number, place: number) => void) {
    this.logX = spec.x.logarithmic ?? false;
    this.logY = spec.y.logarithmic ?? false;
    const toggle = (name: string, get: () => boolean, set: (on: boolean) => void): HTMLButtonElement => {
      const button = el("button", { type: "button", class: "quiet", "aria-pressed": String(get()), onclick: () => {
        set(!get());
        button.setAttribute("aria-pressed", String(get()));
        this.draw();
      } }, name);
      return button;
    };
    const tools = el("div", { class: "tools" },
      toggle("log x", () => this.logX, (on) => { this.logX = on; }),
      toggle("log y", () => this.logY, (on) => { this.logY = on; }),
      el("button", { type: "button", class: "quiet", title: "Show the whole range; so does a double click", onclick: () => this.draw() }, "reset"),
      el("button", { type: "button", class: "quiet csv", "aria-label": "Numbers of this figure as CSV", onclick: () => download(this.fileName(), csvOf(this.spec)) }, "CSV"));
    this.element = el("figure", { class: "chart", id: `chart-${this.number}` }, el("div", { class: "head" }, this.title, tools), this.keys, this.host,
      this.readout, this.caption);
    new ResizeObserver(() => {
      if (this.host.clientWidth !== this.width) {
        this.draw();
      }
    }).observe(this.host);
    onTheme(() => this.draw());
    this.set(spec);
  }

  /** Replaces what is shown; what the reader switched off stays off. */
  set(spec: ChartSpec): void {
    for (const series of spec.series) {
      if (series.hidden && !this.known.has(series.name)) {
        this.hidden.add(series.name);
      }
    }
    for (const series of spec.series) {
      this.known.add(series.name);
    }
    this.spec = spec;
    this.title.textContent = spec.title;
    this.caption.textContent = spec.note ?? "";
    this.host.setAttribute("aria-label", described(spec));
    this.draw();
  }

  /** Shows or hides the series of this name. */
  show(name: string, on: boolean): void {
    if (this.spec.series.some((series) => series.name === name)) {
      on ? this.hidden.delete(name) : this.hidden.add(name);
      this.draw();
    }
  }

  private fileName(): string {
    return `${this.spec.title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "")}.csv`;
  }

  /** One button for each name; series of one name are switched together. */
  private drawKeys(): void {
    const names = [...new Set(this.spec.series.map((series) => series.name))];
    this.keys.replaceChildren(...names.map((name) => {
      const series = this.spec.series.find((one) => one.name === name)!;
      const mark = series.kind === "points" ? (series.shape === "triangle" ? "▲" : "●") : series.kind === "bars" ? "■" : dashOf(series).mark;
      return el("button", { type: "button", class: "key", "aria-pressed": String(!this.hidden.has(name)), title: "Show or hide", onclick: () => {
        this.hidden.has(name) ? this.hidden.delete(name) : this.hidden.add(name);
        this.draw();
      } }, el("i", { style: `color: var(${series.colour})`, "aria-hidden": "true" }, mark), name);
    }));
    this.keys.hidden = names.length < 2;
  }

  private draw(): void {
    this.drawKeys();
    this.width = this.host.clientWidth;
    this.plot?.destroy();
    this.plot = null;
    this.readout.textContent = "\u00a0";
    if (this.width < 40) {
      return;
    }
    const shown = this.spec.series.filter((series) => !this.hidden.has(series.name));
    this.threshold = this.logY ? thresholdOf(shown) : null;
    const positive = (values: (number | null)[]): (number | null)[] => (this.logY && this.threshold === null ? values.map((v) => (v !== null && v > 0 ? v : null)) : values);
    const usable = this.logX ? shown.map((series) => keptAbove(series)) : shown;
    const table = joined(usable);
    const data = [table.x, ...table.columns.map(positive)] as uPlot.AlignedData;
    this.plot = new uPlot(this.options(usable, table), data, this.host);
  }

  private options(series: Series[], table: Table): uPlot.Options {
    const bars = series.filter((one) => one.kind === "bars").length;
    let bar = 0;
    return {
      width: this.width,
      height: this.spec.height ?? 270,
      legend: { show: false },
      cursor: { drag: { x: true, y: true, uni: 40 }, points: { size: 7 } },
      scales: {
        x: { time: false, distr: this.logX ? 3 : 1, range: (_, low, high) => widened(low, high, this.logX, bars > 0 ? 0.04 : 0.015) },
        y: { distr: this.threshold !== null ? 4 : this.logY ? 3 : 1, asinh: this.threshold ?? 1, range: (_, low, high) => this.rangeY(low, high, series, bars > 0) },
      },
      padding: [10, 14, 0, 0],
      axes: [axis(this.spec.x.label, 28, this.logX, null), axis(this.spec.y.label, 48, this.logY, this.threshold)],
      series: [{}, ...series.map((one) => seriesOptions(one, one.kind === "bars" ? { number: bar++, of: bars } : { number: 0, of: 1 }))],
      hooks: {
        drawClear: [(plot) => this.drawBand(plot)],
        draw: [(plot) => drawPoints(plot, series, table), (plot) => this.drawMarks(plot)],
        setCursor: [(plot) => this.read(plot, series)],
        ready: [(plot) => this.listen(plot, series)],
      },
    };
  }

  private rangeY(low: number, high: number, series: Series[], fromZero: boolean): [number, number] {
    if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) {
      return this.logY ? [1, 10] : [0, 1];
    }
    let [from, to] = [low, high];
    for (const one of series) {
      one.error?.forEach((error, k) => {
        const value = one.y[k];
        if (error !== null && value !== null && value !== undefined && value >= low && value <= high) {
          to = Math.max(to, value + error);
          from = Math.min(from, this.logY && this.threshold === null ? Math.max(value - error, 0.3 * value) : value - error); // a bar may reach beyond a logarithmic axis
        }
      });
    }
    if (this.threshold !== null) {
      return [from < 0 ? 1.6 * from : -this.threshold, to > 0 ? 1.6 * to : this.threshold];
    }
    if (this.spec.zero) {
      const reach = Math.max(4, Math.abs(from), Math.abs(to)) * 1.08;
      return [-reach, reach];
    }
    return (fromZero || from < 0.1 * to) && !this.logY && from >= 0 ? [0, to * 1.05] : widened(from, to, this.logY, 0.05);
  }

  private drawBand(plot: uPlot): void {
    if (this.spec.band) {
      const [top, bottom] = [plot.valToPos(this.spec.band[1], "y", true), plot.valToPos(this.spec.band[0], "y", true)];
      plot.ctx.fillStyle = colour("--pale");
      plot.ctx.fillRect(plot.bbox.left, Math.max(top, plot.bbox.top), plot.bbox.width, Math.min(bottom, plot.bbox.top + plot.bbox.height) - Math.max(top, plot.bbox.top));
    }
  }

  private drawMarks(plot: uPlot): void {
    const { ctx, bbox } = plot;
    for (const mark of this.spec.marks ?? []) {
      const at = plot.valToPos(mark.x, "x", true);
      if (at < bbox.left - 1 || at > bbox.left + bbox.width + 1) {
        continue;
      }
      ctx.save();
      ctx.strokeStyle = ctx.fillStyle = colour(mark.colour);
      ctx.lineWidth = 2 * devicePixelRatio;
      ctx.beginPath();
      ctx.moveTo(at, bbox.top);
      ctx.lineTo(at, bbox.top + bbox.height);
      ctx.stroke();
      const right = at > bbox.left + 0.6 * bbox.width;
      ctx.font = `${12 * devicePixelRatio}px ${fontFamily()}`;
      ctx.textAlign = right ? "right" : "left";
      ctx.fillText(mark.label, at + (right ? -6 : 6) * devicePixelRatio, bbox.top + 14 * devicePixelRatio);
      ctx.restore();
    }
  }

  /** A click near a point picks it; the end of a drag, which zooms, does not. */
  private listen(plot: uPlot, series: Series[]): void {
    if (!this.pick) {
      return;
    }
    const near = 12; // pixels
    let start = [0, 0];
    plot.over.addEventListener("mousedown", (event) => { start = [event.offsetX, event.offsetY]; });
    plot.over.addEventListener("click", (event) => {
      const [x, y] = [event.offsetX, event.offsetY];
      const points = Math.hypot(x - start[0]!, y - start[1]!) > 4 ? [] : series.flatMap((one) => one.x.map((value, place) => ({
        series: this.spec.series.findIndex((other) => other.name === one.name), place,
        away: Math.hypot(plot.valToPos(value, "x") - x, plot.valToPos(one.y[place] ?? NaN, "y") - y) })));
      const nearest = points.filter(({ away }) => away < near).sort((a, b) => a.away - b.away)[0];
      if (nearest) {
        this.pick!(nearest.series, nearest.place);
      }
    });
  }

  /** The values under the pointer, of each series the nearest. */
  private read(plot: uPlot, series: Series[]): void {
    const { left } = plot.cursor;
    if (left === undefined || left < 0) {
      this.readout.textContent = "\u00a0";
      return;
    }
    const x = plot.posToVal(left, "x");
    const parts = series.flatMap((one) => {
      const k = nearest(one, x, this.logX);
      return k < 0 || one.y[k] === null ? [] : [`${one.name} ${printed(one.y[k]!)}`];
    });
    this.readout.textContent = `${this.spec.x.label.replace(/ \[.*/, "")} ${printed(x)}: ${parts.join(" · ")}`;
  }
}

function keptAbove(series: Series): Series {
  const keep = series.x.map((x) => x > 0);
  const kept = <T>(list: T[]): T[] => list.filter((_, k) => keep[k]);
  return { ...series, x: kept(series.x), y: kept(series.y), error: series.error && kept(series.error), open: series.open && kept(series.open) };
}

/** Where measured values are not above zero, the smallest size that tells them apart on an axis of both signs; else null. */
function thresholdOf(series: Series[]): number | null {
  const measured = series.filter((one) => one.kind === "points").flatMap((one) => one.y).filter((value): value is number => value !== null);
  if (!measured.some((value) => value <= 0)) {
    return null;
  }
  const sizes = measured.map(Math.abs).filter((size) => size > 0);
  const most = sizes.reduce((a, b) => Math.max(a, b), 0);
  return most > 0 ? Math.max(sizes.reduce((a, b) => Math.min(a, b)), 1e-4 * most) : 1;
}

function nearest(series: Series, x: number, logarithmic: boolean): number {
  let best = -1;
  let distance = Infinity;
  series.x.forEach((place, k) => {
    const away = logarithmic ? Math.abs(Math.log(place / x)) : Math.abs(place - x);
    if (series.y[k] !== null && away < distance) {
      distance = away;
      best = k;
    }
  });
  return best;
}

function widened(low: number, high: number, logarithmic: boolean, part: number): [number, number] {
  if (low === null || high === null) {
    return logarithmic ? [1, 10] : [0, 1];
  }
  if (logarithmic) {
    const factor = low === high ? 2 : (high / low) ** part;
    return [low / factor, high * factor];
  }
  const margin = low === high ? Math.abs(low) * 0.1 || 1 : part * (high - low);
  return [low - margin, high + margin];
}

function fontFamily(): string {
  return getComputedStyle(document.body).fontFamily;
}

function axis(label: string, size: number, logarithmic: boolean, threshold: number | null): uPlot.Axis {
  return {
    label, size, labelSize: 20, labelGap: 0, gap: 4, font: `12px ${fontFamily()}`, labelFont: `12.5px ${fontFamily()}`,
    stroke: () => colour("--ink"),
    grid: { stroke: () => colour("--grid"), width: 1 },
    ticks: { stroke: () => colour("--rule"), width: 1, size: 5 },
    border: { show: true, stroke: () => colour("--rule"), width: 1 },
    filter: (_, splits) => splits,
    splits: threshold !== null ? (_plot, _axis, low, high) => signedTicks(low, high, threshold)
      : logarithmic ? (_plot, _axis, low, high) => logarithmicTicks(low, high) : undefined,
    values: (_, ticks) => tickLabels(ticks, logarithmic),
  };
}

function seriesOptions(series: Series, bar: { number: number; of: number }): uPlot.Series {
  const stroke = (): string => colour(series.colour);
  if (series.kind === "bars") {
    const align = bar.of === 2 ? (bar.number === 0 ? -1 : 1) : 0;
    return { stroke, fill: () => `${colour(series.colour)}cc`, width: 0, points: { show: false },
      paths: uPlot.paths.bars!({ size: [bar.of === 2 ? 0.42 : 0.84], align: align as 0 | 1 | -1 }) };
  }
  if (series.kind === "points") {
    return { stroke, paths: () => null, points: { show: false } };
  }
  return { stroke, width: series.width ?? 2, dash: dashOf(series).pattern, spanGaps: true, points: { show: false } };
}

function drawPoints(plot: uPlot, series: Series[], table: Table): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  series.forEach((one, s) => {
    if (one.kind !== "points") {
      return;
    }
    ctx.strokeStyle = colour(one.colour);
    ctx.lineWidth = 1.2 * devicePixelRatio;
    table.x.forEach((x, row) => {
      const y = plot.data[s + 1]![row];
      if (y !== null && y !== undefined) {
        drawPoint(plot, one, table.origin[s]![row]!, x, y);
      }
    });
  });
  ctx.restore();
}

function drawPoint(plot: uPlot, series: Series, k: number, x: number, y: number): void {
  const { ctx } = plot;
  const radius = 3.2 * devicePixelRatio;
  const at = plot.valToPos(x, "x", true);
  const height = plot.valToPos(y, "y", true);
  const error = series.error?.[k];
  if (error) {
    const low = y - error > 0 || plot.scales.y!.distr !== 3 ? plot.valToPos(y - error, "y", true) : plot.bbox.top + plot.bbox.height;
    ctx.beginPath();
    ctx.moveTo(at, plot.valToPos(y + error, "y", true));
    ctx.lineTo(at, low);
    ctx.stroke();
  }
  ctx.beginPath();
  if (series.shape === "triangle") {
    ctx.moveTo(at, height - 1.25 * radius);
    ctx.lineTo(at + 1.15 * radius, height + 0.85 * radius);
    ctx.lineTo(at - 1.15 * radius, height + 0.85 * radius);
    ctx.closePath();
  } else {
    ctx.arc(at, height, radius, 0, 2 * Math.PI);
  }
  ctx.fillStyle = series.open?.[k] ? colour("--paper") : colour(series.colour);
  ctx.fill();
  ctx.stroke();
}
