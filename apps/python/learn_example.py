"""Trains a linear probe that tells models apart, on views that it renders: learn_example.py MODEL.glb MODEL.glb ..."""

import sys
from typing import Any

import bdpt
import numpy as np
from numpy.typing import NDArray


def features(view: bdpt.View) -> NDArray[Any]:
    """Returns colours and inverse depths of a view, 16 x 16, and 1."""
    near = 1 / view.layers["depth"][..., None]
    pixels = np.concatenate([view.rgb / 255, near / near.max()], axis=2)
    small = pixels.reshape(16, 2, 16, 2, 4).mean(axis=(1, 3))
    return np.append(small.ravel(), 1)


def examples(models: list[str], views: int, seed: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """Returns the features of views of all models, one row each, and the models' numbers."""
    rows, labels = [], []
    for number, model in enumerate(models):
        for view in bdpt.dataset(model, views, seed=seed, size=(32, 32), spp=4, aov="depth"):
            rows.append(features(view))
            labels.append(number)
    return np.array(rows), np.array(labels)


def main(models: list[str]) -> None:
    x, labels = examples(models, views=40, seed=1)
    goal = np.eye(len(models))[labels]
    weights = np.linalg.solve(x.T @ x + 0.1 * np.eye(x.shape[1]), x.T @ goal)  # ridge regression
    x, labels = examples(models, views=20, seed=2)
    right = (x @ weights).argmax(axis=1) == labels
    print(f"right: {100 * right.mean():.0f} %")


main(sys.argv[1:])
