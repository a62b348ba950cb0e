"""The measures of image_error.h once more, from scikit-image and SciPy: metrics_check.py DIR

DIR/pairs.csv names pairs of pictures (rows of 4 floats: linear light times cover, cover) and what was measured of them.
Ends with 1 if anything differs by more than its bound.
"""
import csv
import pathlib
import sys

import numpy as np
from scipy import ndimage
from skimage.metrics import structural_similarity

SKY = np.array([0.42, 0.56, 0.76])
BOUNDS = {"cover": 1e-6, "iou": 1e-6, "silhouette": 1e-6, "colour": 1e-7, "ssim": 1e-4, "gmsd": 1e-6, "psnr": 1e-5}


def srgb(linear):
    c = np.clip(linear, 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def seen(picture):
    return srgb(picture[..., :3] + (1 - picture[..., 3:]) * SKY)


def luma(picture):
    return 255 * seen(picture) @ np.array([0.2126, 0.7152, 0.0722])


def gradient(plane):
    h, w = plane.shape
    even = np.pad(plane, ((0, h % 2), (0, w % 2)), mode="edge")
    half = (even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2]) / 4
    return np.hypot(ndimage.prewitt(half, 0, mode="nearest"), ndimage.prewitt(half, 1, mode="nearest")) / 3


def measured(a, b):
    cover_a, cover_b = a[..., 3], b[..., 3]
    both, either = ((f(cover_a >= 0.5, cover_b >= 0.5)).sum() for f in (np.logical_and, np.logical_or))
    light = b[..., :3].sum((0, 1)) / cover_b.sum() - a[..., :3].sum((0, 1)) / cover_a.sum()
    y, x = np.mgrid[-5:6, -5:6]
    judged = ndimage.binary_dilation((cover_a > 0) | (cover_b > 0), x * x + y * y <= 25)
    p, q = luma(a), luma(b)
    _, ssim = structural_similarity(p, q, data_range=255, gaussian_weights=True, sigma=1.5,
                                    use_sample_covariance=False, full=True)
    ga, gb = gradient(p), gradient(q)
    similar = (2 * ga * gb + 170) / (ga * ga + gb * gb + 170)
    similar = similar.repeat(2, 0).repeat(2, 1)[:p.shape[0], :p.shape[1]]
    squares = ((seen(a) - seen(b)) ** 2)[judged].mean()
    return {"cover": cover_b.sum() / cover_a.sum(), "iou": both / either,
            "silhouette": np.abs(cover_a - cover_b).sum() / cover_a.sum(), "colour": np.sqrt((light ** 2).mean()),
            "ssim": ssim[judged].mean(), "gmsd": similar[judged].std(), "psnr": -10 * np.log10(squares)}


def main(folder):
    worst = dict.fromkeys(BOUNDS, 0.0)
    pairs = list(csv.DictReader(open(folder / "pairs.csv", encoding="utf-8")))
    for pair in pairs:
        shape = (int(pair["height"]), int(pair["width"]), 4)
        a, b = (np.fromfile(folder / pair[side], np.float32).astype(float).reshape(shape) for side in ("a", "b"))
        for name, value in measured(a, b).items():
            worst[name] = max(worst[name], abs(value - float(pair[name])))
    print(f"{len(pairs)} pairs, largest differences:", ", ".join(f"{k} {v:.2g}" for k, v in worst.items()))
    return int(len(pairs) < 10 or any(not worst[k] <= BOUNDS[k] for k in BOUNDS))


sys.exit(main(pathlib.Path(sys.argv[1])))
