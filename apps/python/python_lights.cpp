#include <bdpt/light_desc.h>
#include <nanobind/stl/string.h>

#include "arrays.h"
#include "attributes.h"
#include "python_scene.h"

namespace bdpt::python {

namespace nb = nanobind;

void bind_lights(nb::module_& module)
{
    nb::class_<PointLightDesc> point(module, "PointLight", "A point light: isotropic.");
    point.def("__init__", &construct<PointLightDesc>, nb::arg("attributes"));
    point.def_rw("name", &PointLightDesc::name, "Name in id layers.");
    def_vec(point, "position", &PointLightDesc::position, "[m]");
    def_vec(point, "intensity", &PointLightDesc::intensity, "[cd]");
    point.def_rw("radius", &PointLightDesc::radius, "[m] 0: a point; else a sphere that is seen.");
    nb::class_<SpotLightDesc> spot(module, "SpotLight", "A point light in a cone.");
    spot.def("__init__", &construct<SpotLightDesc>, nb::arg("attributes"));
    spot.def_rw("name", &SpotLightDesc::name, "Name in id layers.");
    def_vec(spot, "position", &SpotLightDesc::position, "[m]");
    def_vec(spot, "direction", &SpotLightDesc::direction, "The axis.");
    def_vec(spot, "intensity", &SpotLightDesc::intensity, "[cd] within the inner cone");
    spot.def_rw("inner_cone_angle", &SpotLightDesc::inner_cone_angle, "[rad] from the axis");
    spot.def_rw("outer_cone_angle", &SpotLightDesc::outer_cone_angle, "[rad] from the axis");
    spot.def_rw("radius", &SpotLightDesc::radius, "[m] 0: a point; else a sphere that is seen.");
    nb::class_<DirectionalLightDesc> sun(module, "DirectionalLight", "A directional light.");
    sun.def("__init__", &construct<DirectionalLightDesc>, nb::arg("attributes"));
    def_vec(sun, "direction", &DirectionalLightDesc::direction, "Direction in which the light "
                                                                "travels.");
    def_vec(sun, "illuminance", &DirectionalLightDesc::illuminance,
            "[lx] on a surface facing the light");
    nb::class_<EnvironmentLightDesc>(module, "EnvironmentLight", "Light from infinity.")
        .def(
            "__init__",
            [](EnvironmentLightDesc* self, const ImageInput& radiance) {
                new (self) EnvironmentLightDesc{.radiance = to_image(radiance)};
            },
            nb::arg("radiance"),
            "An equirectangular array of float32 (height, width, 3) [nit]: the top row is +y, the "
            "centre column is seen along -z. Of shape (1, 1, 3) it is constant.");
}

}  // namespace bdpt::python
