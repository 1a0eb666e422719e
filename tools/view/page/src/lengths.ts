// Lengths as the rules write them: 0.5 in scene units, "2%" of the scene's diagonal, "20vx" voxels.
import type { State } from './api';

export type Length = number | string;

/// Returns scene units; NaN if the text is no length.
export function toWorld(length: Length, scene: State['scene']): number {
  if (typeof length === 'number') return length;
  const match = /^\s*([0-9.eE+-]+)\s*(%|vx)?\s*$/.exec(length), value = match ? Number(match[1]) : NaN;
  if (!match || !Number.isFinite(value) || value < 0) return NaN;
  return match[2] === '%' ? (value / 100) * scene.diagonal : match[2] === 'vx' ? value * scene.voxel : value;
}

/// Returns the value for JSON: a number without a unit becomes a number.
export function parse(text: string): Length {
  const trimmed = text.trim();
  return trimmed !== '' && Number.isFinite(Number(trimmed)) ? Number(trimmed) : trimmed.replace(/\s+/g, '');
}

export function show(value: number, digits = 3): string {
  return String(Number(value.toPrecision(digits)));
}

export function percent(world: number, scene: State['scene']): string {
  return `${show((world / scene.diagonal) * 100, 2)}%`;
}

/// Maps a slider from 0 to 1000 to percent, by powers. With `zero` the left end is 0.
export const slide = {
  least: 0.05, most: 20,
  toPercent(at: number, zero = false): number { return zero && at === 0 ? 0 : slide.least * Math.pow(slide.most / slide.least, at / 1000); },
  fromPercent(value: number): number {
    return Math.round(1000 * Math.min(1, Math.max(0, Math.log(value / slide.least) / Math.log(slide.most / slide.least))));
  },
};
export const faceSlide = {
  least: 50, most: 50000,
  to(at: number): number { return Number((faceSlide.least * Math.pow(faceSlide.most / faceSlide.least, at / 1000)).toPrecision(2)); },
  from(n: number): number {
    return Math.round(1000 * Math.min(1, Math.max(0, Math.log(n / faceSlide.least) / Math.log(faceSlide.most / faceSlide.least))));
  },
};
