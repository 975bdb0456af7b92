"""Lists ways to break light transport on purpose, each by one change of the code. `bdpt verify` must detect them."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Breakage:
    """Replaces `old`, which occurs once in the file, by `new`; `bdpt verify` must then fail on the scene."""

    name: str
    file: str
    old: str
    new: str
    scene: str = "cornell-box.gltf"
    options: tuple = ()  # options of `bdpt verify`


JOINER = "lib/src/integrator/bidirectional/path_joiner.cpp"
CONNECT = "lib/src/path/connect.cpp"
WALK = "lib/src/path/random_walk.cpp"
SUMS = "lib/src/path/weight_sums.cpp"
CAMERA = "lib/src/camera/camera.cpp"
CACHE = "lib/src/integrator/bidirectional/light_path_cache.cpp"
TRACER = "lib/src/integrator/path/path_integrator.cpp"
LIGHT_SET = "lib/src/scene/light_set.cpp"
LIGHTS = "lib/src/scene/light_set.h"

# The lens is so wide, and so far inside the box, that light paths hit it.
WIDE_LENS = ("--lens-radius", "0.1", "--from", "0.278,0.273,-0.1", "--look-at", "0.278,0.273,0.28", "--fov", "100")
SHARED = ("--light-paths", "0.25", "--connections", "1.5")
CHOSEN = ("--light-paths", "0.25", "--connections", "4", "--connection-rays", "3")
SKY = ("--env", "default")
FOG = ("--fog", "0.3,0.6,1.2", "--fog-anisotropy", "0.5", "--max-depth", "4")
# The point lies in the roughest sphere of glass-rough.gltf, below the lamp.
INSIDE_GLASS = ("--from", "1.05,0.29,0.3", "--look-at", "1.05,1.5,0.31", "--fov", "90")

BREAKAGES = (
    Breakage("walks in media leave out the probability of their flight", WALK,
             "pdf_of_point(cosine, distance_squared) * event.probability();", "pdf_of_point(cosine, distance_squared);",
             options=FOG),
    Breakage("reverse densities take points of media for surfaces", "lib/src/path/path_vertex.h",
             "transmission.pdf_of_end(vertex.kind == VertexKind::medium)", "transmission.pdf_of_end(false)",
             options=FOG),
    Breakage("media choose distances by all colours and weigh them by one", "lib/src/scene/media.cpp",
             ".p_unscattered = mean(left)", ".p_unscattered = left.r", options=FOG),
    Breakage("phase functions sample backwards", "lib/src/material/medium.cpp",
             ".wi = {sine * c, sine * s, z}", ".wi = {sine * c, sine * s, -z}", options=FOG),
    Breakage("a join lacks 1/d^2", CONNECT, "f_y.f_cos * y.beta * (1.0f / distance_squared)",
             "f_y.f_cos * y.beta"),
    Breakage("the longest light subpath is not joined", JOINER,
             "options_.transport.max_depth + 1 - t);", "options_.transport.max_depth - t);"),
    Breakage("splats begin at s = 3", JOINER,
             "for (int s = 2; s <= max_s; ++s) {\n        if (strategies_.uses(s, 1)",
             "for (int s = 3; s <= max_s; ++s) {\n        if (strategies_.uses(s, 1)"),
    Breakage("survivors of roulette are not worth more", "lib/src/path/direct_light.h", "    beta /= survival;\n", ""),
    Breakage("area densities of walks lack the cosine", "lib/src/path/random_walk.h",
             ": to_area(pdf, cosine, distance_squared);", ": to_area(pdf, 1.0f, distance_squared);"),
    Breakage("reverse densities of walks are halved", WALK,
             "scattered->pdf_rev.value * previous.area_per_solid_angle",
             "0.5f * scattered->pdf_rev.value * previous.area_per_solid_angle", "cornell-box-hidden.gltf"),
    Breakage("the density of camera rays is that of cos^-2", CAMERA, "inv_cos * inv_cos * inv_cos / film_area_",
             "inv_cos * inv_cos / film_area_"),
    Breakage("the importance of a lens that is hit lacks the cosine", CAMERA,
             "pdf_direction.value * pdf_lens_.value / d.z", "pdf_direction.value * pdf_lens_.value",
             options=WIDE_LENS),
    Breakage("joins lack the adjoint factor of shading normals", "lib/src/material/bsdf.cpp",
             "value.f_cos *= cosines.ratio() / ratio_o_;", "static_cast<void>(cosines);", "shading-normals.gltf"),
    Breakage("walks have the adjoint factor upside down", "lib/src/material/bsdf.cpp",
             "sampled->weight *= cosines.ratio() / ratio_o_;", "sampled->weight *= ratio_o_ / cosines.ratio();",
             "shading-normals.gltf"),
    Breakage("light paths do not see silhouettes as the lens does", CONNECT,
             "y.bsdf->eval_to_lens(to_lens->wi)", "y.bsdf->eval(to_lens->wi, TransportMode::importance)",
             "shading-normals.gltf"),
    Breakage("refraction lacks 1/eta^2 in camera paths", "lib/src/material/lobes/boundary_lobes.h",
             "lobe.f_cos * compression(n_o, n_i, mode)",
             "lobe.f_cos * (mode == TransportMode::radiance ? 1.0f : 1.0f)", "glass-rough.gltf",
             INSIDE_GLASS),
    Breakage("light leaves a surface with the cosine twice", "lib/src/light/triangle_light.cpp",
             "(pi * sides * from.inverse_pdf)", "(2.0f * local.z * pi * sides * from.inverse_pdf)"),
    Breakage("points of textured emitters have one density", "lib/src/light/triangle_light.cpp",
             "emission_.spread ? emission_.spread->pdf(triangle_to_square(barycentrics)) : 1.0f", "1.0f",
             "textured-emitter.gltf"),
    Breakage("next-event estimation on sphere lights has half the density", "lib/src/light/sphere_light.cpp",
             "SolidAnglePdf pdf() const { return cone_pdf(one_minus_cos); }",
             "SolidAnglePdf pdf() const { return {0.5f * cone_pdf(one_minus_cos).value}; }", "veach-plates.gltf"),
    Breakage("weights forget next-event estimation", SUMS,
             "? light_samples_ * raise(quotient(light[0].pdf_next_event, light[0].pdf_fwd))", "? joins_",
             "veach-plates.gltf"),
    Breakage("weights count joins to earlier camera vertices twice", SUMS,
             "camera_term(path.first(k), path[k]) +", "2.0 * camera_term(path.first(k), path[k]) +"),
    Breakage("weights of joins forget merging", SUMS,
             "camera_term(path.first(k), path[k]) + merge_term(path[k], path[k].pdf_fwd)",
             "camera_term(path.first(k), path[k])",
             options=("--integrator", "vcm", "--max-depth", "4")),
    Breakage("merges take the light of a sun from where it goes", "lib/src/path/merge.cpp", "? before_y.end.p",
             "? -before_y.end.p", "room-sun.gltf", ("--integrator", "vcm", "--max-depth", "4")),
    Breakage("weights take points of fog for chosen on each segment", TRACER, "? fog_sampling_->samples() *", "? 1.0f *",
             "night-market.gltf", ("--fog", "0.05", "--max-depth", "3")),
    Breakage("points of fog count light samples as one", TRACER, "pdf * (probability * light_samples_),\n        transmission.pdf_scatter",
             "pdf * probability,\n        transmission.pdf_scatter", options=(*FOG, "--light-samples", "4")),
    Breakage("weights count lenses that are hit twice", SUMS, "finite_lens_ ? splats_ :",
             "finite_lens_ ? 2.0 * splats_ :", options=WIDE_LENS),
    Breakage("weights take connections for as many as light paths", SUMS, "joins_(raise(strategies.connections()))",
             "joins_(raise(strategies.light_paths()))", options=SHARED),
    Breakage("the fraction of a connection is dropped", CACHE,
             "std::floor(before + counts_.connections) - std::floor(before)", "std::floor(counts_.connections)",
             options=SHARED),
    Breakage("chosen connections are not divided by their chance", JOINER, "found->unweighted *= each.scale;", "",
             options=CHOSEN),
    Breakage("connections of small estimates are never chosen", "lib/src/integrator/bidirectional/connection_chooser.cpp",
             "const float expected = estimates.of_vertices[i] * rate + of_pair;",
             "const float expected = estimates.of_vertices[i] * rate > 0.1f ? estimates.of_vertices[i] * rate + of_pair : 0.0f;",
             options=CHOSEN),
    Breakage("splats of shared light paths count as those of own ones", JOINER,
             "strategy, *found, strategies_.count(strategy.s, strategy.t),", "strategy, *found, 1.0f,", options=SHARED),
    Breakage("shadow rays to infinity meet nothing", "lib/src/scene/world.cpp",
             "    const Ray ray = ray_from(a, direction, segment);\n    Rgb passing(1.0f);\n    if (is_blocked(",
             "    const Ray ray = ray_from(a, direction, segment);\n    Rgb passing(1.0f);\n    if (false && is_blocked(",
             "room-environment.gltf", SKY),
    Breakage("hits take the light of suns for uniform over the disk", LIGHT_SET,
             "window != nullptr ? window->pdf(p, -to_light)", "false ? window->pdf(p, -to_light)", "room-sun.gltf"),
    Breakage("light of suns that enters as learned is worth that of the disk", "lib/src/light/delta_lights.cpp",
             ".weight = illuminance_ / entry.pdf.value", ".weight = illuminance_ / bounds_.pdf_disk().value", "room-sun.gltf"),
    Breakage("numbers within learned windows are not stretched", "lib/src/light/learned/entries.cpp",
             "cells_->sample({rest, u.y}).point", "cells_->sample({u.x, u.y}).point", "room-sun.gltf"),
    Breakage("hits take tiles of the sky for unlearned", LIGHTS, "pdf_incident(with_visibility(receiver, id, sampling), x0,",
             "pdf_incident(receiver, x0,", "room-environment.gltf", SKY),
    Breakage("samples take tiles of the sky for unlearned", LIGHTS, "with_visibility(receiver, choice->id, sampling), choice->u,",
             "receiver, choice->u,", "room-environment.gltf", SKY),
    Breakage("hits take the light of the sky for uniform over the disk", LIGHT_SET, ".direction = {}, .entry = pdf.entry",
             ".direction = {}, .entry = bounds_.pdf_disk()", "room-environment.gltf", SKY),
    Breakage("light of the sky that enters as learned is worth that of the disk", "lib/src/light/environment_light.cpp",
             "(from.pdf.value * entry.pdf.value)", "(from.pdf.value * bounds_.pdf_disk().value)", "room-environment.gltf", SKY),
    Breakage("hits take shares of groups of lights for unlearned", LIGHTS,
             "shares != nullptr ? next_event_.probability(id,", "false && shares ? next_event_.probability(id,",
             "cornell-box-hidden.gltf", SKY),
    Breakage("numbers within learned groups are not stretched", "lib/src/scene/next_event_lights.cpp",
             "std::min(u / static_cast<double>(shares[group]), below_one)", "std::min(u, below_one)", "cornell-box-hidden.gltf", SKY),
    Breakage("hits take starts of light paths for unlearned", LIGHT_SET, "chosen = emission_probability(id, learned)",
             "chosen = emission_probability(id)", "cornell-box-hidden.gltf", SKY),
    Breakage("light paths start unlearned", WALK, "sampler.next_fine(); }, sampling.learned);", "sampler.next_fine(); });",
             "cornell-box-hidden.gltf", SKY),
    Breakage("shadow rays pass blended surfaces by what these block", "lib/src/geometry/ray_passage.cpp",
             "crossing.factor = (1.0f - crossing.opacity) * tint();", "crossing.factor = crossing.opacity * tint();", "alpha.gltf"),
)
