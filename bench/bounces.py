#!/usr/bin/env python3
"""Fits the light of further bounces on rough metals (shaders/physics/surface.glsl) to walks.

Least squares over roughness .2 to 1, nine of f0 and ten eyes: first the energy (four numbers),
then where it goes (five): its first moments from roughness .5 on, and balls under one light from
0 to 125 degrees beside the eye, from .4 on.  Prints both fits beside the numbers of surface.glsl,
and how far those are from the walks.  Some minutes.
"""
import math

import numpy

import walk

F0 = numpy.array([0.02, 0.04, 0.1, 0.2, 0.34, 0.5, 0.77, 0.9, 1.0])[:, None]
EYES = (numpy.arange(10) + 0.5) / 10
ENERGY = numpy.array([0.1, 0.24, 0.58, 0.55])
LEAN = numpy.array([1.75, 0.78, 2.8, 2.1, 2.5])

# ---- The walks -------------------------------------------------------------


def moments(alpha, NoV, count=1 << 16):
    """Albedo of one bounce; of the others that, and times z and x (forwards): one row each f0."""
    draw = numpy.random.default_rng(0)
    d = numpy.tile([math.sqrt(1 - NoV * NoV), 0, -NoV], (count, 1))
    height, weight = numpy.ones(count), numpy.ones((len(F0), count))
    single, more = 0, 0
    for met in range(200):
        lambdas, share = walk.smith(d[:, 2], alpha), 1 - draw.random(len(d))
        leaves = (d[:, 2] > 0) & (share <= height ** numpy.maximum(lambdas, 0))
        w = weight[:, leaves]
        if met == 1:
            single = w.sum(1) / count
        elif met:
            out = numpy.stack([numpy.ones(w.shape[1]), d[leaves, 2], d[leaves, 0]], -1)
            more = more + w @ out / count
        d, height, lambdas, share = (x[~leaves] for x in (d, height, lambdas, share))
        if not len(d):
            break
        height = numpy.minimum(height * share ** (-1 / lambdas), 1)
        facet = walk.visible_normals(-d, alpha, draw)
        cosine = numpy.clip(-walk.dots(d, facet), 0, 1)
        weight = weight[:, ~leaves] * walk.schlick(F0, cosine)
        d = walk.unit(d + 2 * cosine[:, None] * facet)
    return single, more


def lobe(alpha, NoV, steps=150):
    """The DFG table's pair: of visible normals, the share that is not shadowed."""
    u, phi = numpy.meshgrid((numpy.arange(steps) + 0.5) / steps,
                            math.pi * (numpy.arange(steps) + 0.5) / steps)
    v = numpy.array([math.sqrt(1 - NoV * NoV), 0, NoV])
    s = walk.unit(v * [alpha, alpha, 1])
    z = 1 - u * (1 + s[2])
    r = numpy.sqrt(numpy.clip(1 - z * z, 0, 1))
    h = walk.unit(numpy.stack([alpha * (r * numpy.cos(phi) + s[0]), alpha * r * numpy.sin(phi),
                               z + s[2]], -1))
    VoH = numpy.clip(h @ v, 0, 1)
    up = 2 * VoH * h[..., 2] - NoV
    of_eye = 1 + walk.smith(numpy.array(NoV), alpha)
    seen = numpy.where(up > 0, of_eye / (of_eye + walk.smith(numpy.maximum(up, 1e-5), alpha)), 0)
    grazing = (1 - VoH) ** 5
    return (seen * (1 - grazing)).mean(), (seen * grazing).mean()


# ---- The formulas of surface.glsl ------------------------------------------


def energy(p, alpha, NoV, e0, e1):
    """Further bounces, and the share of Fresnel's rise in what their facets reflect."""
    s, e = 1 - alpha, e0 + e1
    w = (p[0] + s * (p[1] + p[2] * s ** 3)) * (1 - p[3] * NoV * (1 + F0))
    mean, leaving = F0 + (1 - F0) * w, numpy.sqrt(e)
    bounced = (F0 * e0 + e1) * mean * (1 - e) / (leaving * (1 - mean * (1 - leaving)))
    return bounced, (1 - F0) * w / mean


def lean(p, alpha, NoV, grazed):
    s = 1 - alpha
    up = numpy.maximum(p[0] * numpy.sqrt(NoV) - p[1] - p[2] * (s ** 3 + grazed), -2)
    most = numpy.minimum(1 - numpy.maximum(2 / 3 * up, up / 2), 1.2)
    return up, numpy.minimum(p[3] * s ** 3 + p[4] * s * grazed, most)


# ---- Both ------------------------------------------------------------------


class Eyes:
    """A roughness seen from ten sides."""

    def __init__(self, roughness):
        self.alpha = roughness ** 2
        walked = [moments(self.alpha, NoV) for NoV in EYES]
        self.single = numpy.stack([w[0] for w in walked], -1)
        self.more, self.up, self.forwards = numpy.moveaxis(numpy.stack([w[1] for w in walked]),
                                                           (0, 1, 2), (2, 1, 0))
        self.e0, self.e1 = numpy.transpose([lobe(self.alpha, NoV) for NoV in EYES])
        self.scale = 1 / (self.single + self.more + 0.04)

    def energy_errors(self, p):
        return (energy(p, self.alpha, EYES, self.e0, self.e1)[0] - self.more) * self.scale

    def moment_errors(self, p):
        bounced, grazed = energy(ENERGY, self.alpha, EYES, self.e0, self.e1)
        up, forwards = lean(p, self.alpha, EYES, grazed)
        # 1/18 and 1/4 are the variances of z and of x under cosine-weighted directions.
        return numpy.stack([bounced * up / 18 - (self.up - 2 / 3 * self.more),
                            bounced * forwards * numpy.sqrt(1 - EYES ** 2) / 4 - self.forwards]
                           ) * self.scale


class Ball:
    """A roughness as a ball under a light far away."""

    def __init__(self, roughness, degrees, count=1 << 15):
        self.alpha, angle = roughness ** 2, math.radians(degrees)
        light = numpy.array([math.sin(angle), 0, math.cos(angle)])
        wo, wi = walk.ball(1e6 * light, 0, count, numpy.random.default_rng(1))
        self.single = walk.one_bounce(wo, wi, self.alpha, F0, walk.schlick).mean(1)
        self.more = walk.walk(wo, self.alpha, F0, walk.schlick, wi).mean(1)
        self.NoV, self.NoL, self.LoV = wo[:, 2], wi[:, 2], math.cos(angle)
        table = numpy.transpose([lobe(self.alpha, c) for c in numpy.linspace(0.02, 1, 50)])
        self.e0, self.e1 = (numpy.interp(self.NoV, numpy.linspace(0.02, 1, 50), e) for e in table)

    def errors(self, p):
        bounced, grazed = energy(ENERGY, self.alpha, self.NoV, self.e0, self.e1)
        up, forwards = lean(p, self.alpha, self.NoV, grazed)
        shape = 1 + up * (self.NoL - 2 / 3) - forwards * (self.LoV - self.NoL * self.NoV)
        ours = (bounced * shape * self.NoL / math.pi).mean(1)
        return (ours - self.more) / (self.single + self.more)


def fit(errors, p):
    """Gauss and Newton."""
    for _ in range(8):
        e = errors(p)
        slopes = numpy.stack([(errors(p + step) - e) / 1e-4 for step in 1e-4 * numpy.eye(len(p))])
        p = p - numpy.linalg.lstsq(slopes.T, e, rcond=None)[0]
    return p


def all_of(parts):
    return numpy.concatenate([numpy.ravel(x) for x in parts])


eyes = [Eyes(r / 10) for r in range(2, 11)]
balls = [Ball(r / 10, d) for r in range(4, 11) for d in range(0, 126, 25)]


def energy_errors(p):
    return all_of(x.energy_errors(p) for x in eyes)


def lean_errors(p):
    return all_of([x.moment_errors(p) for x in eyes[3:]] + [x.errors(p) for x in balls])


for name, errors, ours in (("energy", energy_errors, ENERGY), ("lean", lean_errors, LEAN)):
    best = fit(errors, ours)
    print("%-7s fit  %s  root mean square error %.4f" % (
        name, " ".join("%6.3f" % x for x in best), math.sqrt((errors(best) ** 2).mean())))
    print("       ours  %s                         %.4f, at most %.3f" % (
        " ".join("%6.3f" % x for x in ours), math.sqrt((errors(ours) ** 2).mean()),
        abs(errors(ours)).max()))
