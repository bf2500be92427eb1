"""coal's distance and collision query beside bryla's, on the pairs of benches/closest.rs.

    pip install coal numpy            and bryla's own wheel
    python benches/peers/coal_closest.py

Both are called from Python. What a call costs is taken off coal's times, measured by the same loop over two balls,
whose distance is a closed form; bryla takes all poses in one call. Coal's poses are made beforehand, bryla's time
includes their conversion and the arrays of the answers. Warm queries start from the last one (coal: the cached guess),
cold ones anew. Least thread time of several repetitions; the last column is the largest difference of the signed
distances as a fraction of the size.
"""

import math
import platform
import time

import bryla
import coal
import numpy as np

SIZES = (8, 32, 128, 512, 2048)
QUERIES = 512
REPETITIONS = 15


def points(count, axes, phase):
    """Points spread over an ellipsoid along a golden spiral."""
    k = np.arange(count)
    z = 1.0 - (2.0 * k + 1.0) / count
    angle = math.pi * (3.0 - math.sqrt(5.0)) * k + phase
    r = np.sqrt(1.0 - z * z)
    return np.stack([axes[0] * r * np.cos(angle), axes[1] * r * np.sin(angle), axes[2] * z], axis=1)


def poses(distance, step):
    """Positions and orientations (w, x, y, z) of B about A."""
    if step is None:
        random = np.random.default_rng(7)
        q, d = random.uniform(-1.0, 1.0, (QUERIES, 4)), random.uniform(-1.0, 1.0, (QUERIES, 3))
        return distance * d / np.linalg.norm(d, axis=1)[:, None], q / np.linalg.norm(q, axis=1)[:, None]
    x = step * np.arange(QUERIES)
    around, up = 0.37 * x, 0.5 * np.sin(0.11 * x)
    position = np.stack([np.cos(around) * np.cos(up), np.sin(around) * np.cos(up), np.sin(up)], axis=1)
    axis = np.array([0.6, 0.0, 0.8])
    return distance * position, np.concatenate([np.cos(x / 2)[:, None], np.sin(x / 2)[:, None] * axis], axis=1)


def coal_hull(p):
    """A convex hull of coal's."""
    cloud = coal.StdVec_Vec3s()
    for v in p:
        cloud.append(v)
    return coal.Convex.convexHull(cloud, False, None)


def rotation(q):
    """The matrix of a unit quaternion."""
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def coal_queries(a, b, transforms, warm):
    """Nanoseconds a call, and the signed distances."""
    home = coal.Transform3s()
    query = coal.ComputeDistance(a, b)
    best, found = math.inf, None
    for _ in range(REPETITIONS):
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        request.enable_signed_distance = True
        if warm:
            request.gjk_initial_guess = coal.GJKInitialGuess.CachedGuess
        found = []
        began = time.thread_time_ns()
        for transform in transforms:
            result.clear()
            found.append(query(home, transform, request, result))
            if warm:
                request.updateGuess(result)
        best = min(best, (time.thread_time_ns() - began) / len(transforms))
    return best, np.array(found)


def bryla_queries(a, b, x, q, warm):
    """Nanoseconds a pose of one call with many, and the signed distances."""
    home = bryla.Pose((0, 0, 0), (1, 0, 0, 0))
    best, found = math.inf, None
    for _ in range(REPETITIONS):
        began = time.thread_time_ns()
        found = bryla.closest_features_many(a, home, b, (x, q), warm=warm)
        best = min(best, (time.thread_time_ns() - began) / len(x))
    return best, found["signed_distance"]


def main():
    """Prints the table."""
    print(
        f"coal {coal.__version__}, bryla {bryla.__version__}, Python {platform.python_version()}, {time.strftime('%F')}"
    )
    ball = coal.Sphere(0.1)
    print("| regime | motion | vertices | bryla ns | coal ns | ratio | largest difference |")
    print("|---|---|---|---|---|---|---|")
    for regime, distance in (("apart", 2.6), ("overlapping", 1.2)):
        for motion, step in (("cold", None), ("1e-2", 1e-2), ("1e-3", 1e-3)):
            x, q = poses(distance, step)
            transforms = [coal.Transform3s(rotation(o), p) for p, o in zip(x, q, strict=True)]
            call, _ = coal_queries(ball, ball, transforms, step is not None)
            for size in SIZES:
                p, r = points(size, (1.0, 0.8, 0.6), 0.0), points(size, (0.9, 1.0, 0.7), 1.0)
                hulls = [bryla.Collider(bryla.ConvexPolyhedron(cloud)) for cloud in (p, r)]
                ours, d = bryla_queries(*hulls, x, q, step is not None)
                theirs, e = coal_queries(coal_hull(p), coal_hull(r), transforms, step is not None)
                theirs -= call
                off = np.max(np.abs(d - e)) / (2.0 + distance)
                print(f"| {regime} | {motion} | {size} | {ours:.0f} | {theirs:.0f} | {theirs / ours:.1f} | {off:.0e} |")


if __name__ == "__main__":
    main()
