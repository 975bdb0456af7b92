"""Defines the user settings of the add-on, of scenes and of view layers, their panels, and which panels of Blender the
engine shares."""

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
INTEGRATORS = [("auto", "Automatic", "A short test render chooses the integrator that has less noise"),
               ("bdpt", "Bidirectional", "Bidirectional path tracing"),
               ("mis", "Path Tracing", "Unidirectional path tracing with next-event estimation"),
               ("vcm", "Vertex Merging", "Vertex connection and merging: for caustics seen in mirrors; consistent, but biased")]


class BDPT_Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: bpy.props.StringProperty(
        name="Command", subtype="FILE_PATH", default="",
        description="The program bdpt. Empty: that of PATH, or of Blender's Python environment")

    def draw(self, context):
        self.layout.prop(self, "command")


class BDPT_SceneSettings(bpy.types.PropertyGroup):
    samples: bpy.props.IntProperty(name="Samples", default=64, min=1, description="Samples per pixel at most")
    time: bpy.props.FloatProperty(name="Time Limit", default=0.0, min=0.0, subtype="TIME_ABSOLUTE", unit="TIME_ABSOLUTE",
                                  description="Seconds to render for at most; 0 is no limit")
    noise: bpy.props.FloatProperty(name="Noise Limit", default=0.0, min=0.0, max=100.0, subtype="PERCENTAGE", precision=1,
                                   description="Stop when the noise is that low; 0 renders all samples")
    denoise: bpy.props.BoolProperty(name="Denoise", default=False, description="Filter the image with Open Image Denoise")
    integrator: bpy.props.EnumProperty(name="Integrator", items=INTEGRATORS, default="auto",
                                       description="How paths of light are found")
    max_depth: bpy.props.IntProperty(name="Max Depth", default=64, min=1, max=4096,
                                     description="Longest path of light, in edges: one more than its bounces")
    options: bpy.props.StringProperty(name="Options", default="",
                                      description="More options of the command bdpt render, as one types them. Jobs may have the same: none "
                                                  "that load code, connect to machines or write other files")


def passes_changed(self, context):
    context.view_layer.update_render_passes()


class BDPT_LayerSettings(bpy.types.PropertyGroup):
    use_pass_denoising_data: bpy.props.BoolProperty(
        name="Denoising Data", default=False, update=passes_changed,
        description="Passes of albedo and normal for denoising in the compositor, and of the noisy image")


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

    def draw(self, context):
        column = self.column()
        for name in self.settings:
            column.prop(context.scene.bdpt, name)


class BDPT_PT_sampling(Panel):
    bl_label = "Sampling"
    settings = ("samples", "time", "noise", "denoise")


class BDPT_PT_light_paths(Panel):
    bl_label = "Light Paths"
    settings = ("integrator", "max_depth", "options")


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


CLASSES = (BDPT_Preferences, BDPT_SceneSettings, BDPT_LayerSettings, BDPT_PT_sampling,
           BDPT_PT_light_paths, BDPT_PT_film, BDPT_PT_motion_blur, BDPT_PT_passes)


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
    bpy.types.Scene.bdpt = bpy.props.PointerProperty(type=BDPT_SceneSettings)
    bpy.types.ViewLayer.bdpt = bpy.props.PointerProperty(type=BDPT_LayerSettings)
    for panel in shared_panels():
        panel.COMPAT_ENGINES.add(ENGINE)


def unregister():
    for panel in shared_panels():
        panel.COMPAT_ENGINES.discard(ENGINE)
    del bpy.types.ViewLayer.bdpt
    del bpy.types.Scene.bdpt
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)


def chosen_command():
    addon = bpy.context.preferences.addons.get(__package__)
    return addon.preferences.command if addon else ""
