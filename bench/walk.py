"""Random walks on a rough surface: Heitz, Hanika, d'Eon & Dachsbacher, Multiple-Scattering
Microfacet BSDFs with the Smith Model, 2016; isotropic GGX, reflection.

Directions are rows, z = normal, and leave the surface: `wo` to the eye, `wi` to the light.  `f0` is
a number, or a column of several; what is returned has a row for each.
"""
import math

import numpy

numpy.seterr(all="ignore")  # walks that have ended go on unseen


def schlick(f0, cosine):
    return f0 + (1 - f0) * (1 - cosine) ** 5


# Cycles' Fresnel goes from f0 to 1 as that of glass does; glTF's is Schlick's.  Of this index
# the two have the same mean over the hemisphere; of 1.5 Cycles' is 13 % higher above f0.
INDEX = 1.345


def glass(f0, cosine):
    g = numpy.sqrt(INDEX * INDEX - 1 + cosine * cosine)
    ratio = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1)
    f = ((g - cosine) / (g + cosine)) ** 2 * (1 + ratio * ratio) / 2
    least = ((INDEX - 1) / (INDEX + 1)) ** 2
    return f0 + (1 - f0) * (f - least) / (1 - least)


def unit(v):
    return v / numpy.linalg.norm(v, axis=-1, keepdims=True)


def dots(a, b):
    return (a * b).sum(-1)


def smith(z, alpha):
    """Lambda; of a direction down, -1 - that of its opposite."""
    z = numpy.where(abs(z) < 1e-5, 1e-5, z)
    return (numpy.sign(z) * numpy.sqrt(1 + alpha ** 2 * (1 / (z * z) - 1)) - 1) / 2


def distribution(z, alpha):
    return numpy.where(z > 0, alpha ** 2 / math.pi / (1 + (alpha ** 2 - 1) * z * z) ** 2, 0)


def visible_normals(v, alpha, draw):
    """Dupuy & Benyoub 2023, from below too."""
    scale = numpy.array([alpha, alpha, 1])
    s = unit(v * scale)
    z = 1 - draw.random(len(v)) * (1 + s[:, 2])
    r, phi = numpy.sqrt(numpy.clip(1 - z * z, 0, 1)), 2 * math.pi * draw.random(len(v))
    return unit((numpy.stack([r * numpy.cos(phi), r * numpy.sin(phi), z], -1) + s) * scale)


def one_bounce(wo, wi, alpha, f0, fresnel):
    h = unit(wo + wi)
    return (fresnel(f0, dots(wo, h)) * distribution(h[:, 2], alpha) / (4 * wo[:, 2])
            / (1 + smith(wo[:, 2], alpha) + smith(wi[:, 2], alpha)))


def ball(light, center, count, draw):
    """`wo` and `wi` at places of a ball's disk that see the light; the eye is far along z."""
    r, phi = 0.97 * numpy.sqrt(draw.random(count)), 2 * math.pi * draw.random(count)
    n = numpy.stack([r * numpy.cos(phi), r * numpy.sin(phi), numpy.sqrt(1 - r * r)], -1)
    light = unit(numpy.array(light) - center - n)
    n, light = n[dots(n, light) > 0.01], light[dots(n, light) > 0.01]
    x = unit(numpy.array([0, 0, 1]) - n[:, 2:] * n)
    y = numpy.cross(n, x)
    return (numpy.stack([x[:, 2], y[:, 2], n[:, 2]], -1),
            numpy.stack([dots(light, x), dots(light, y), dots(light, n)], -1))


def walk(wo, alpha, f0, fresnel, wi=None, as_cycles=False):
    """The albedo seen from each of wo, or the light of wi after more than one bounce, BRDF times
    cosine.

    `as_cycles`: as Cycles 3.4 evaluates it under a light: from the lower direction, after a
    bounce upwards at the top of the surface, its Fresnel squared, ten bounces.
    """
    draw, factor, start = numpy.random.default_rng(0), 1, 1
    if as_cycles:
        low = (wi[:, 2] < wo[:, 2])[:, None]
        factor = numpy.where(low[:, 0], wi[:, 2] / wo[:, 2], 1)
        wo, wi = numpy.where(low, wi, wo), numpy.where(low, wo, wi)
        start = fresnel(f0, dots(wi, unit(wo + wi)))
    d, sums = -wo, numpy.zeros(len(wo))
    height, alive = numpy.ones(len(wo)), numpy.full(len(wo), True)
    weight = start * height
    for order in range(10 if as_cycles else 40):
        lambdas, share = smith(d[:, 2], alpha), 1 - draw.random(len(d))
        leaves = alive & (d[:, 2] > 0) & (share <= height ** numpy.maximum(lambdas, 0))
        if wi is None:
            sums = sums + numpy.where(leaves, weight, 0)
        alive &= ~leaves
        down = numpy.minimum(height * share ** (-1 / lambdas), 1)
        height = numpy.where(lambdas > 0, 1, down) if as_cycles else down
        v, facet = -d, visible_normals(-d, alpha, draw)
        if wi is not None and order > 0:
            h = unit(v + wi)
            area = (v[:, 2] + numpy.sqrt(v[:, 2] ** 2 + alpha ** 2 * (1 - v[:, 2] ** 2))) / 2
            last = weight if as_cycles else fresnel(f0, numpy.clip(dots(v, h), 0, 1))
            p = distribution(h[:, 2], alpha) / (4 * area) * height ** smith(wi[:, 2], alpha)
            sums = sums + numpy.where(alive, weight * last * p, 0)
        cosine = numpy.clip(dots(v, facet), 0, 1)
        if not as_cycles or order > 0:
            weight = weight * fresnel(f0, cosine)
        d = unit(d + 2 * cosine[:, None] * facet)
    return sums * factor
