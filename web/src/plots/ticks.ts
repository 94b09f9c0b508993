// SPDX-License-Identifier: GPL-3.0-or-later
// Where the ticks of an axis stand, and what stands at them.

import { printed, raised } from "../dom";

/** Ticks of a logarithmic axis: powers of ten, over few decades also their multiples, over a part of one even steps. */
export function logarithmicTicks(low: number, high: number): number[] {
  const decades = Math.log10(high / low);
  if (!(decades > 0.4) || !Number.isFinite(decades)) {
    const step = niceStep((high - low) / 5);
    const first = Math.ceil(low / step);
    return Array.from({ length: Math.max(0, Math.min(20, Math.floor(high / step) - first + 1)) }, (_, k) => Number(((first + k) * step).toPrecision(12)));
  }
  const multiples = decades > 3 ? [1] : decades > 1.2 ? [1, 2, 5] : [1, 2, 3, 4, 5, 7];
  const every = Math.ceil(decades / 9);
  const ticks: number[] = [];
  for (let exponent = Math.floor(Math.log10(low)); exponent <= Math.log10(high); exponent += every) {
    ticks.push(...multiples.map((multiple) => Number(`${multiple}e${exponent}`)));
  }
  return ticks.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

function niceStep(rough: number): number {
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5, 10].find((multiple) => multiple * power >= rough) ?? 10);
}

/** Ticks of an axis that is logarithmic on either side of zero and linear below `threshold`: zero and powers of ten of both signs. */
export function signedTicks(low: number, high: number, threshold: number): number[] {
  const largest = Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high))));
  const smallest = Math.min(largest, Math.ceil(Math.log10(threshold)));
  const every = Math.ceil((largest - smallest + 1) / 4);
  const powers: number[] = [];
  for (let exponent = largest; exponent >= smallest; exponent -= every) {
    powers.push(Number(`1e${exponent}`));
  }
  const ticks = [...powers.map((power) => -power), 0, ...powers.reverse()];
  return ticks.filter((tick) => tick >= low && tick <= high);
}

/** The numbers at ticks, all in one manner: as powers of ten where one of them needs it. */
export function tickLabels(ticks: (number | null)[], logarithmic: boolean): string[] {
  const known = ticks.filter((tick): tick is number => tick !== null && tick !== 0);
  const powers = known.length > 0 && known.every((tick) => Math.abs(Math.log10(Math.abs(tick)) - Math.round(Math.log10(Math.abs(tick)))) < 1e-9);
  const extreme = known.some((tick) => Math.abs(tick) < 0.999e-2 || Math.abs(tick) > 1.001e4);
  return ticks.map((tick) => {
    if (tick === null || !logarithmic || !powers || !extreme || tick === 0) {
      return tick === null ? "" : printed(tick, 3).replace(/^(−?)1 × /, "$1");
    }
    return `${tick < 0 ? "−" : ""}10${raised(Math.round(Math.log10(Math.abs(tick))))}`;
  });
}
