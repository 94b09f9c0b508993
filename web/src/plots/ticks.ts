// Where the ticks of an axis stand.

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
