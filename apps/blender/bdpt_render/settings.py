"""Defines the user settings of the add-on, of scenes and of view layers."""

import bpy

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


CLASSES = (BDPT_Preferences, BDPT_SceneSettings, BDPT_LayerSettings)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.bdpt = bpy.props.PointerProperty(type=BDPT_SceneSettings)
    bpy.types.ViewLayer.bdpt = bpy.props.PointerProperty(type=BDPT_LayerSettings)


def unregister():
    del bpy.types.ViewLayer.bdpt
    del bpy.types.Scene.bdpt
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)


def chosen_command():
    addon = bpy.context.preferences.addons.get(__package__)
    return addon.preferences.command if addon else ""
