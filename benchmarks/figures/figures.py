"""Defines the figures as lists of cells, each a scene and options of `bdpt render`. make_figures.py renders them."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Cell:
    """Describes one image of a sheet. It has either a number of samples (`spp`) or a render time (`seconds`)."""

    label: str
    scene: str  # a file of scenes/
    options: tuple  # options of `bdpt render`
    spp: int = None
    seconds: float = None
    reference: tuple = None  # options of the reference by bdpt, which has the same light; None: no reference
    rival: tuple = None  # options of a second estimate: the image is the mean of maxima of the two (biased!)
    rounds: int = 1  # number of maxima in the mean, each of images of spp / rounds samples
    layer: str = None  # layer that the cell shows in false colours, with one scale for the sheet
    layer_scale: float = 1.5  # end of the colour scale, over the layer's mean
    metric: str = "relmse"  # error metric of `bdpt compare`


@dataclasses.dataclass(frozen=True)
class Figure:
    """Describes one sheet, `columns` cells wide."""

    title: str
    columns: int
    cells: tuple
    reference_spp: int = 2048
    exposure: float = None  # [EV]; None takes the automatic one of the scene's last reference


def strategies(max_light, max_camera, keep):
    """Returns `--disable` with all strategies of at most that many vertices for which `keep(s, t)` does not hold."""
    pairs = ((s, t) for s in range(max_light + 1) for t in range(max_camera + 1) if s + t >= 2)
    names = [f"s{s}t{t}" for s, t in pairs if not keep(s, t)]
    return ("--disable", ",".join(names)) if names else ()


def depth(edges):
    return ("--max-depth", str(edges))


def by(integrator):
    return ("--integrator", integrator)


def adaptive():
    """Compares at equal average samples; times differ where samples are not equally expensive."""
    cells = []
    for scene in ("cornell-spheres.gltf", "alpha.gltf"):
        options = by("mis") + depth(5)
        more = (*options, "--adaptive", "--aov", "samples")
        cells += [Cell("uniform", scene, options, 128, reference=depth(5)),
                  Cell("adaptive", scene, more, 128, reference=depth(5)),
                  Cell("samples taken", scene, more, 128, reference=depth(5), layer="sampleCount.Y", layer_scale=4.0)]
    return tuple(cells)


def lengths_grid(splats):
    """Limits camera subpaths to m edges and light subpaths to w edges. Together they make all paths of up to m + w + 1
    edges, which the reference shows; without splats (t = 1) camera subpaths of 0 edges make none."""
    cells = []
    for m in range(6):
        for w in range(6):
            options = ("--max-camera-depth", str(m), "--max-light-depth", str(w)) + depth(11)
            options += () if splats else strategies(w + 1, 1, lambda s, t: t > 1)
            reference = depth(m + w + 1) if m > 0 or (splats and w > 0) else None
            cells.append(Cell(f"m = {m}, w = {w}", "cornell-lambertian-hidden.gltf", options, 4, reference=reference))
    return tuple(cells)


def light_lengths():
    """Compares light subpath limits that all estimate the same image: paths of up to 6 edges."""
    cells = []
    for scene in ("cornell-spheres.gltf", "cornell-spheres-hidden.gltf"):
        cells.append(Cell("path tracing (mis)", scene, by("mis") + depth(6), 16, reference=depth(6)))
        cells += [Cell(f"w = {w}", scene, ("--max-light-depth", str(w)) + depth(6), 16, reference=depth(6))
                  for w in range(6)]
    return tuple(cells)


def greater_of_two():
    cells = []
    for scene in ("cornell-spheres-hidden.gltf", "cornell-lambertian-hidden.gltf"):
        paths, both = by("mis") + depth(6), depth(6)
        cells += [Cell("path tracing", scene, paths, 16, reference=both),
                  Cell("bdpt, weighted: unbiased", scene, both, 16, reference=both),
                  Cell("BIASED: greater per sample", scene, both, 16, reference=both, rival=paths, rounds=16),
                  Cell("BIASED: greater image", scene, both, 16, reference=both, rival=paths)]
    return tuple(cells)


def single_scatter():
    cells = []
    for scene in ("cornell-box.gltf", "lamp-box.gltf"):
        three_edges = depth(3) + strategies(3, 4, lambda s, t: s + t == 4)
        alone = depth(3) + strategies(3, 4, lambda s, t: (s, t) == (2, 2))
        cells += [Cell("1 x 1 connection (s2t2)", scene, alone, 16, reference=three_edges),
                  Cell("all of three edges", scene, three_edges, 16, reference=three_edges)]
    return tuple(cells)


def lamp_box():
    """Makes a row for each pair of lengths e-l: camera subpaths of e edges and light subpaths of l edges."""
    cells = []
    for camera, light in ((2, 3), (2, 4), (3, 3)):
        edges, scene, spp = camera + light + 1, "lamp-box.gltf", 16
        whole = depth(edges)
        cells += [Cell(f"{name.upper()}, {edges} edges", scene, by(name) + whole, spp, reference=whole)
                  for name in ("pt", "nee", "mis")]
        limits = ("--max-camera-depth", str(camera), "--max-light-depth", str(light)) + whole
        ends = strategies(light + 1, camera + 1, lambda s, t: (s, t) == (light + 1, camera + 1))
        same = strategies(edges, edges, lambda s, t: s + t == edges + 1)
        cells += [Cell(f"{camera}-{light} end to end only", scene, limits + ends, spp, reference=whole + same),
                  Cell(f"{camera}-{light} all connections", scene,
                       limits + strategies(light + 1, camera + 1, lambda s, t: t > 1), spp, reference=whole),
                  Cell(f"bdpt, {edges} edges", scene, whole, spp, reference=whole)]
    return tuple(cells)


def lamp_box_short():
    """Compares light subpaths that end inside the box with those whose second edge leaves it; all estimate the same
    image."""
    scene, whole = "lamp-box.gltf", depth(6)
    cells = []
    for light, where in ((0, "no edge"), (1, "1 edge: ends in the box"), (2, "2 edges: leaves it"), (3, "3 edges")):
        limits = ("--max-camera-depth", "5", "--max-light-depth", str(light)) + whole
        cells.append(Cell(where, scene, limits + strategies(light + 1, 6, lambda s, t: t > 1), 16, reference=whole))
    return tuple(cells)


def pinhole_or_lens():
    """Compares a pinhole and a lens at equal samples."""
    views = (("pinhole", ("--lens-radius", "0")), ("lens", ()))
    return tuple(Cell(f"{name}, {view}", "nine-spheres-dof.gltf", by(name) + depth(5) + options, 64,
                      reference=depth(5) + options)
                 for name in ("mis", "bdpt") for view, options in views)


def light_paths():
    cells = []
    for scene in ("fourteen-specular.gltf", "cornell-spheres-hidden.gltf"):
        for limit in ({"spp": 16}, {"seconds": 10.0}):
            cells += [Cell(f"{count} light path{'s' if count > 1 else ''}", scene,
                           ("--light-paths", str(count)) + depth(6), reference=depth(6), **limit)
                      for count in (1, 2, 5, 10)]
    return tuple(cells)


def light_samples():
    """Makes a row at equal samples and one at equal time for each scene."""
    cells = []
    for scene in ("cornell-box.gltf", "night-market.gltf"):
        for limit in ({"spp": 16}, {"seconds": 4.0}):
            cells += [Cell(f"{count} light sample{'s' if count > 1 else ''}", scene,
                           by("mis") + ("--light-samples", str(count)) + depth(5), reference=depth(5), **limit)
                      for count in (1, 4, 16)]
    return tuple(cells)


def heuristics():
    return tuple(Cell(name, scene, ("--heuristic", name) + depth(5), 16, reference=depth(5))
                 for scene in ("veach-plates.gltf", "cornell-box-hidden.gltf")
                 for name in ("balance", "power", "cutoff", "maximum", "uniform"))


def roulette():
    """Compares paths with Russian roulette after three edges and without it, for several length limits. The sample
    counts give equal numbers of rays (by --stats), so that other programs on the machine have no influence."""
    scene = "cornell-box-hidden.gltf"
    rows = (("roulette", (), (128, 128, 128, 128)), ("no roulette", ("--rr-start", "1000"), (117, 85, 65, 57)))
    return tuple(Cell(f"{label}, {edges} edges", scene, by("mis") + more + depth(edges), spp, reference=depth(edges))
                 for label, more, counts in rows for edges, spp in zip((4, 8, 16, 32), counts))


def direct_indirect():
    scene = "cornell-spheres.gltf"
    parts = {"direct only": ("--only", "direct"), "indirect only": ("--only", "indirect"), "direct and indirect": ()}
    return tuple(Cell(label, scene, part + depth(6), 64, reference=part + depth(6)) for label, part in parts.items())


def denoised():
    """Makes a row for each scene: path tracing and the default integrator, raw and denoised, at equal time. Splats are
    denoised with the rest."""
    cells = []
    for scene in ("lamp-box.gltf", "caustic-metal.gltf", "glass-rough.gltf"):
        for name in ("mis", "auto"):
            cells += [Cell(f"{name}{label}", scene, by(name) + depth(8) + more, seconds=2.0, reference=depth(8),
                           metric="flip")
                      for label, more in (("", ()), (", denoised", ("--denoise",)))]
        cells.append(Cell("reference", scene, depth(8), 1024, reference=depth(8), metric="flip"))
    return tuple(cells)


def media():
    """Makes a row for each scene, at equal time."""
    cells = []
    for scene, options in (("fog-beam.gltf", ("--fog", "0.12") + depth(12)), ("tea-glass.gltf", depth(32)),
                           ("candle.gltf", depth(64))):
        cells += [Cell(name, scene, by(name) + options, seconds=4.0, reference=options) for name in ("mis", "bdpt", "auto")]
    return tuple(cells)


def sweep(scene, integrators, counts, edges):
    """Makes a row for each integrator and a column for each number of samples."""
    return tuple(Cell(f"{name}, {count} spp", scene, by(name) + depth(edges), count, reference=depth(edges))
                 for name in integrators for count in counts)


FIGURES = {
    "lengths-grid": Figure("6 x 6 lengths of camera (m) and light (w) subpaths, without splats", 6,
                           lengths_grid(splats=False)),
    "lengths-grid-splats": Figure("The same with splats (t = 1), which the reports did not have", 6,
                                  lengths_grid(splats=True)),
    "light-lengths": Figure("Light subpaths of 0 to 5 edges, beside plain path tracing", 7, light_lengths()),
    "greater-of-two": Figure("The greater of two estimates is biased; the weighted sum is not", 4, greater_of_two()),
    "single-scatter": Figure("One point of the camera joined to one of the light", 2, single_scatter()),
    "lamp-box": Figure("PT, NEE, MIS, end to end only and all connections: 2-3, 2-4, 3-3", 6, lamp_box()),
    "lamp-box-short": Figure("Light subpaths too short to leave the lamp's box, and longer ones", 4, lamp_box_short()),
    "veach-plates": Figure("Veach's plates by BSDF sampling, light sampling and both", 4,
                           sweep("veach-plates.gltf", ("pt", "nee", "mis", "bdpt"), (16,), 2), exposure=-5.0),
    "fourteen-specular": Figure("PT and BDPT after 2, 10, 100, 1000 iterations", 4,
                                sweep("fourteen-specular.gltf", ("pt", "bdpt"), (2, 10, 100, 1000), 5), 8192),
    "depth-of-field": Figure("A thin lens at equal time", 3, tuple(
        Cell(name, "nine-spheres-dof.gltf", by(name) + depth(5), seconds=20.0, reference=depth(5))
        for name in ("pt", "mis", "bdpt"))),
    "pinhole-or-lens": Figure("A pinhole and a thin lens at equal samples", 4, pinhole_or_lens()),
    "light-paths": Figure("1, 2, 5, 10 light paths for each camera path, at equal samples, then at equal time", 4,
                          light_paths()),
    "hemisphere-light": Figure("Hemisphere (pt) against light sampling (nee), direct light", 4,
                               sweep("cornell-box.gltf", ("pt", "nee"), (1, 4, 16, 64), 2)),
    "light-samples": Figure("1, 4, 16 light samples at each vertex, at equal samples, then at equal time", 3,
                            light_samples()),
    "heuristics": Figure("Five heuristics at equal samples", 5, heuristics()),
    "roulette": Figure("With and without Russian roulette, at equal numbers of rays", 4, roulette()),
    "direct-indirect": Figure("Direct only and indirect only", 3, direct_indirect()),
    "depths": Figure("Depth 0, 1, 2, 3, 100 of the reports", 5, tuple(
        Cell(f"depth {bounces}", "cornell-spheres.gltf", depth(bounces + 1), 64, reference=depth(bounces + 1))
        for bounces in (0, 1, 2, 3, 100))),
    "samples": Figure("1 to 1024 samples per pixel", 11, sweep(
        "cornell-box-hidden.gltf", ("mis", "bdpt"), tuple(2 ** k for k in range(11)), 6), 8192),
    "hidden-lamp": Figure("Balls under a hidden lamp, as path tracers have it, and in under a minute", 3, (
        Cell("mis, 256 spp", "cornell-spheres-hidden.gltf", by("mis") + depth(6), 256, reference=depth(6)),
        Cell("bdpt, 16 spp", "cornell-spheres-hidden.gltf", depth(6), 16, reference=depth(6)),
        Cell("bdpt, 50 s", "cornell-spheres-hidden.gltf", depth(6), seconds=50.0, reference=depth(6)))),
    "denoise": Figure("Denoised by Open Image Denoise, at equal time", 5, denoised()),
    "media": Figure("Fog, tea and wax at equal time", 3, media()),
    "rates": Figure("The error falls with the samples: mis, bdpt and auto", 4, tuple(
        Cell(f"{name}, {spp} spp", "cornell-box-hidden.gltf", by(name) + depth(11), spp, reference=depth(11))
        for name in ("mis", "bdpt", "auto") for spp in (4, 16, 64, 256))),
    "adaptive": Figure("Uniform and adaptive at equal samples, and how many each pixel took", 3, adaptive()),
    "rays": Figure("What each integrator spends its rays on", 5, tuple(
        Cell(name, "fourteen-specular.gltf", by(name) + depth(5), 16, reference=None if name == "lt" else depth(5))
        for name in ("pt", "nee", "mis", "lt", "bdpt"))),
}
