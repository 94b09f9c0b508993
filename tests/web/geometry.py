# SPDX-License-Identifier: GPL-3.0-or-later
"""Where spheres are on a screen, from the camera of a view alone: an independent way to what the page draws and picks."""

import h5py
import numpy


class Spheres:
    """Centres and radii in units of the mean radius, from the lower corner of the box."""

    def __init__(self, path):
        with h5py.File(path) as file:
            group = file["particles/trajectory"]
            unit = group["radius"][()].mean()
            self.centres = (group["position/value"][-1] - group["box/origin"][()]) / unit
            self.radii = group["radius"][()] / unit
            self.lengths = numpy.diag(group["box/edges/value"][-1]) / unit
            self.bonds = file["connectivity/bonds"][()] if "connectivity/bonds" in file else None
            self.coordination = numpy.bincount(self.bonds.ravel(), minlength=len(self.radii)) if self.bonds is not None else None


def rays(camera, width, height, pixels):
    """Origins and unit vectors of the rays through pixels [n][2], counted from the upper left corner; parallel ones without perspective."""
    eye, target, up = (numpy.array(camera[name]) for name in ("eye", "target", "up"))
    ahead = (target - eye) / numpy.linalg.norm(target - eye)
    right = numpy.cross(ahead, up)
    right /= numpy.linalg.norm(right)
    above = numpy.cross(right, ahead)
    half = camera["halfHeight"] if camera["parallel"] else numpy.tan(numpy.radians(camera["fieldOfView"]) / 2)
    x = (2 * (pixels[:, 0] + 0.5) / width - 1) * half * width / height
    y = (1 - 2 * (pixels[:, 1] + 0.5) / height) * half
    aside = x[:, None] * right + y[:, None] * above
    if camera["parallel"]:
        return eye + aside, numpy.broadcast_to(ahead, aside.shape)
    return numpy.broadcast_to(eye, aside.shape), (ahead + aside) / numpy.linalg.norm(ahead + aside, axis=1)[:, None]


def first_hits(spheres, camera, width, height, pixels, slab=None):
    """For each pixel the particle that is seen there, or -1, and how far its edge is away in units of its radius.
    slab: (axis, lower, upper)."""
    hits, margins = [], []
    for eye, direction in zip(*rays(camera, width, height, numpy.asarray(pixels, dtype=float))):
        offset = spheres.centres - eye
        along = offset @ direction
        miss = numpy.linalg.norm(offset - along[:, None] * direction, axis=1)
        chord = numpy.sqrt(numpy.maximum(spheres.radii**2 - miss**2, 0))
        enter, leave = along - chord, along + chord
        if slab:
            axis, low, high = slab
            ends = sorted((bound - eye[axis]) / direction[axis] for bound in (low, high))
            enter, leave = numpy.maximum(enter, ends[0]), numpy.minimum(leave, ends[1])
        met = (miss < spheres.radii) & (enter < leave)
        margins.append(numpy.min(numpy.abs(miss - spheres.radii) / spheres.radii))
        hits.append(int(numpy.argmin(numpy.where(met, enter, numpy.inf))) if met.any() else -1)
    return numpy.array(hits), numpy.array(margins)
