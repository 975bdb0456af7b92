"""Defines the panels of the engine, and enables those of Blender that it shares."""

import bpy

ENGINE = "BDPT"
# Panels of EEVEE that apply to any engine.
SHARED = ("EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface", "EEVEE_WORLD_PT_surface", "DATA_PT_EEVEE_light",
          "DATA_PT_camera_dof", "DATA_PT_camera_dof_aperture",
          *(("EEVEE_NEXT_MATERIAL_PT_settings", "EEVEE_NEXT_MATERIAL_PT_settings_surface")
            if (4, 2, 0) <= bpy.app.version < (5, 0, 0) else ("EEVEE_MATERIAL_PT_settings", "EEVEE_MATERIAL_PT_settings_surface")))
# Generic panels that show settings that bdpt lacks, or that repeat the panels above.
EXCLUDED = ("DATA_PT_light", "DATA_PT_area", "DATA_PT_preview", "TEXTURE_PT_preview", "DATA_PT_camera_stereoscopy",
            "RENDER_PT_stereoscopy", "RENDER_PT_output_views")


class Panel(bpy.types.Panel):
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def column(self):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout.column()


class BDPT_PT_sampling(Panel):
    bl_label = "Sampling"

    def draw(self, context):
        column = self.column()
        for name in ("samples", "time", "noise", "denoise"):
            column.prop(context.scene.bdpt, name)


class BDPT_PT_light_paths(Panel):
    bl_label = "Light Paths"

    def draw(self, context):
        column = self.column()
        for name in ("integrator", "max_depth", "options"):
            column.prop(context.scene.bdpt, name)


class BDPT_PT_film(Panel):
    bl_label = "Film"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.column().prop(context.scene.render, "film_transparent", text="Transparent")


class BDPT_PT_motion_blur(Panel):
    bl_label = "Motion Blur"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw(self, context):
        column, render = self.column(), context.scene.render
        column.active = render.use_motion_blur
        if hasattr(render, "motion_blur_position"):
            column.prop(render, "motion_blur_position", text="Position")
        column.prop(render, "motion_blur_shutter")


class BDPT_PT_passes(Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        column, layer = self.column(), context.view_layer
        for name in ("use_pass_z", "use_pass_position", "use_pass_normal"):
            column.prop(layer, name)
        column.prop(layer.bdpt, "use_pass_denoising_data")
        column.prop(layer, "use_pass_cryptomatte_object", text="Cryptomatte Object")
        column.prop(layer, "use_pass_cryptomatte_material", text="Cryptomatte Material")


CLASSES = (BDPT_PT_sampling, BDPT_PT_light_paths, BDPT_PT_film, BDPT_PT_motion_blur, BDPT_PT_passes)


def shared_panels():
    """Returns Blender's panels that work for this engine."""
    for panel in bpy.types.Panel.__subclasses__():
        name, engines = panel.__name__, getattr(panel, "COMPAT_ENGINES", ())
        of_any = "BLENDER_RENDER" in engines and name not in EXCLUDED and "freestyle" not in name
        if isinstance(engines, set) and (of_any or name in SHARED):
            yield panel


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for panel in shared_panels():
        panel.COMPAT_ENGINES.add(ENGINE)


def unregister():
    for panel in shared_panels():
        panel.COMPAT_ENGINES.discard(ENGINE)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
