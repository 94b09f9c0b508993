# SPDX-License-Identifier: GPL-3.0-or-later
"""A bonded network sheared by Yade; a script for that program: yade -nx yade_shear.py, in a folder with a request.json.

Request: "edge", "positions", "tolerance" of the bonds (radii 1), "shear_stiffness" of a contact (normal stiffness 1), and either
"strain" (answer: "bonds" and "moduli" of the planes, after relaxation at constant strain) or "steps" (answer: "seconds" and
"processor_seconds" they take in a cell under shear, the collider at work as usual). The answer goes to answer.json.
"""

import json
import math
import time

from yade import (Bo1_Sphere_Aabb, CohFrictMat, ForceResetter, Ig2_Sphere_Sphere_ScGeom6D, InsertionSortCollider, InteractionLoop,
                  Ip2_CohFrictMat_CohFrictMat_CohFrictPhys, Law2_ScGeom6D_CohFrictPhys_CohesionMoment, Matrix3, NewtonIntegrator, O,
                  utils)

STEP = 0.3  # in sqrt(mass / normal stiffness)
DAMPING = 0.7
UNBALANCED_FORCE = 1e-6  # mean force on a particle over the mean contact force: at rest, also where a network has soft modes
MOST_STEPS = 30000
PLANES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


def set_up(request):
    """Spheres in a periodic cell, bonded as found by the collider: no bond is stretched, none breaks, none resists bending."""
    reach = 1 + request["tolerance"]
    O.periodic = True
    O.cell.setBox(*3 * (request["edge"],))
    # Cohesions beyond any force that occurs; this version takes negative ones ("elastic") for strengths.
    O.materials.append(CohFrictMat(young=1, poisson=request["shear_stiffness"], density=3 / (4 * math.pi), frictionAngle=0,
                                   isCohesive=True, momentRotationLaw=False, normalCohesion=1e9, shearCohesion=1e9))
    O.bodies.append([utils.sphere(place, 1) for place in request["positions"]])
    boxes = Bo1_Sphere_Aabb(aabbEnlargeFactor=reach)
    # Lever arms to the contact point as it is, half the distance; with avoidGranularRatcheting they would be the radii.
    geometry = Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=reach, avoidGranularRatcheting=False)
    contacts = InteractionLoop([geometry], [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
                               [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()])
    O.engines = [ForceResetter(), InsertionSortCollider([boxes], verletDist=0.1, label="collider"), contacts,
                 NewtonIntegrator(damping=DAMPING)]
    O.dt = 1e-12  # the bonds form; nothing moves
    O.step()
    for bond in O.interactions:
        bond.phys.unp = bond.geom.penetrationDepth
        bond.phys.shearForce = bond.phys.normalForce = (0, 0, 0)
    for body in O.bodies:
        body.state.vel = body.state.angVel = (0, 0, 0)
    # No bonds but these from now on.
    boxes.aabbEnlargeFactor = geometry.interactionDetectionFactor = 1
    O.dt = STEP


def velocity_gradient(row, column, rate):
    gradient = Matrix3.Zero
    gradient[row, column] = rate
    return gradient


def modulus(row, column, strain):
    """The cell is sheared in one step, then all is left to come to rest."""
    O.loadTmp("at rest")
    O.cell.velGrad = velocity_gradient(row, column, strain / O.dt)
    O.step()
    O.cell.velGrad = Matrix3.Zero
    for _ in range(MOST_STEPS // 500):
        O.run(500, True)
        if utils.unbalancedForce() < UNBALANCED_FORCE:
            stress = utils.getStress()
            return (stress[row, column] + stress[column, row]) / (2 * strain)
    raise RuntimeError(f"not at rest after {MOST_STEPS} steps")


def seconds_of_steps(steps):
    O.cell.velGrad = velocity_gradient(0, 1, 1e-3 / (steps * O.dt))
    start, processor_start = time.monotonic(), time.process_time()
    O.run(steps, True)
    return {"seconds": time.monotonic() - start, "processor_seconds": time.process_time() - processor_start}


def answer(request):
    set_up(request)
    bonds = O.interactions.countReal()
    if "steps" in request:
        return {"bonds": bonds, **seconds_of_steps(request["steps"])}
    O.saveTmp("at rest")
    return {"bonds": bonds, "moduli": {plane: modulus(*axes, request["strain"]) for plane, axes in PLANES.items()}}


with open("request.json") as file:
    wanted = json.load(file)
found = answer(wanted)
with open("answer.json", "w") as file:
    json.dump(found, file)
