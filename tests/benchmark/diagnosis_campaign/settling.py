# SPDX-License-Identifier: GPL-3.0-or-later
"""A network that settles under its own weight between plates: what a gap of layers shows, by finite volumes in height and time."""

import numpy

LAYERS = 60


def gradients(times, settling, step=0.01):
    """How far the volume fraction of each layer, top first, is from its mean, over the difference between the plates in the end, at these times [s].

    The network consolidates: what flows down is the diffusivity times what the gradient lacks of its end, and nothing goes through the plates.
    `settling` is the time in which the slowest mode decays, gap^2 / (pi^2 diffusivity), 0 of what has settled long before; implicit steps of this part
    of it at most."""
    if settling == 0:
        return numpy.tile((numpy.arange(LAYERS) + 0.5) / LAYERS - 0.5, (len(times), 1))
    diffusivity = LAYERS**2 / numpy.pi**2 / settling  # over the thickness of a layer squared
    flow = diffusivity * (numpy.eye(LAYERS, k=1) - numpy.eye(LAYERS))[:-1]  # through each face, upwards where the fraction falls upwards
    push = numpy.full(LAYERS - 1, -diffusivity / LAYERS)                    # of the weight
    balance = numpy.zeros((LAYERS, LAYERS - 1))
    balance[:-1] += numpy.eye(LAYERS - 1)
    balance[1:] -= numpy.eye(LAYERS - 1)
    state, clock, rows = numpy.zeros(LAYERS), 0.0, []
    for time in times:
        count = max(1, int(numpy.ceil((time - clock) / (step * settling))))
        inverse = numpy.linalg.inv(numpy.eye(LAYERS) - (time - clock) / count * balance @ flow)
        for _ in range(count):
            state = inverse @ (state + (time - clock) / count * balance @ push)
        clock = time
        rows.append(state)
    return numpy.array(rows)


def shown(layers, fractions, difference):
    """Modulus of layers in series over that of the mean volume fraction, row by row; `layers` gives moduli, `fractions` rows of `gradients`."""
    return 1 / numpy.mean(1 / layers(0.4 + difference[:, None] * fractions), axis=1) * layers(0.4)
