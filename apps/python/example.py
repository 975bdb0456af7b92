"""Renders a scene in small steps, and plots how the error falls: example.py SCENE.glb PLOT.png. Needs matplotlib."""

import sys

import bdpt
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def measure_errors(scene, integrator, reference, steps):
    """Returns samples per pixel and relMSE after each step; every step adds its samples to the sum."""
    sum_of_steps, samples, errors = None, [], []
    for begin, end in zip(steps, steps[1:]):
        step = bdpt.render(scene, integrator=integrator, samples=f"{begin}:{end}", size=(160, 120))
        if sum_of_steps is None:
            sum_of_steps = step
        else:
            sum_of_steps += step
        samples.append(sum_of_steps.spp)
        errors.append(bdpt.compare(sum_of_steps.image, reference.image, metrics=["relmse"])["relmse"])
    return samples, errors


def main():
    scene = bdpt.load(sys.argv[1])
    reference = bdpt.render(scene, integrator="bdpt", seed=1, spp=256, size=(160, 120))
    steps = [0, 1, 2, 4, 8, 16, 32]
    figure, (picture, plot) = plt.subplots(1, 2, figsize=(11, 4))
    image = reference.image
    picture.imshow((image / image.mean() / 4).clip(0, 1) ** (1 / 2.2))
    picture.set_axis_off()
    for integrator in ("mis", "bdpt"):
        plot.loglog(*measure_errors(scene, integrator, reference, steps), marker="o", label=integrator)
    plot.set_xlabel("samples per pixel")
    plot.set_ylabel("relMSE")
    plot.legend()
    figure.tight_layout()
    figure.savefig(sys.argv[2])


if __name__ == "__main__":
    main()
