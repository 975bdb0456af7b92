#include <array>
#include <string>

#include "options/option_list.h"

namespace bdpt::job {
namespace {

/// Options of Blender, Mitsuba, pbrt, model-viewer, ffmpeg, ImageMagick and others that mean the
/// same as one of ours.
struct Foreign {
    std::string_view words;  ///< " --width --height "; a space around each
    ForeignOption meant;
};

constexpr std::array<Foreign, 43> foreign_options{{
    {" --width --height --resolution --res --dimensions --image-size --resize --geometry -s -w -W "
     "-H ",
     {"--size", "use --size WIDTHxHEIGHT"}},
    {" --samples-per-pixel --sample-count --num-samples --iterations -n ",
     {"--spp", "use --spp N"}},
    {" --port --host --bind --address -p ", {"--listen", "use --listen 127.0.0.1:PORT"}},
    {" --browser --launch ", {"--open", "use --open"}},
    {" --format --render-format --type --extension -F ",
     {"--output", "the name of the file says it, as in -o NAME.jpg"}},
    {" --out --outfile --output-file --render-output --save ", {"--output", "use -o FILE"}},
    {" --input --infile --in --background-mode -i -b ",
     {"file", "the scene is named without an option, as in bdpt render scene.glb"}},
    {" --overwrite --force -y -f ", {"--output", "existing images are replaced without asking"}},
    {" --gpu --cuda --optix --device --backend --cycles-device --wavefront ",
     {"--threads", "bdpt renders on the processor; --threads N limits its threads"}},
    {" --nthreads --num-threads --cpus --cores --jobs -t -j ", {"--threads", "use --threads N"}},
    {" --engine --renderer --render-engine --method --mode -E -m ",
     {"--integrator", "use --integrator NAME"}},
    {" --frame --render-frame --frame-start --frame-end ",
     {"--frames", "use --frames BEGIN:END, or --frame-time SECONDS for one image"}},
    {" --render-anim --anim --animate -a ", {"--frames", "use --frames BEGIN:END --fps N"}},
    {" --framerate --frame-rate -r ", {"--fps", "use --fps N"}},
    {" --turntable --spin --auto-rotate --rotate ", {"--orbit", "use --orbit N -o NAME.###.png"}},
    {" --camera-orbit --camera-position --eye --origin --position ",
     {"--from", "use --from X,Y,Z and --look-at X,Y,Z, or --view"}},
    {" --target --camera-target --lookat --at ", {"--look-at", "use --look-at X,Y,Z"}},
    {" --field-of-view --camera-fov --angle ", {"--fov", "use --fov DEGREES"}},
    {" --environment --environment-image --envmap --env-map --hdri --skybox --skybox-image --ibl "
     "--sky --world ",
     {"--env", "use --env FILE, default, studio or none"}},
    {" --tonemap --tone-mapping --tonemapping --view-transform --look --curve ",
     {"--tone-map", "use --tone-map NAME"}},
    {" --gamma --brightness --ev --gain ", {"--exposure", "use --exposure EV"}},
    {" --bg --bg-color --background-color --backdrop ",
     {"--background", "use --background COLOUR, FILE or transparent"}},
    {" --alpha --transparent --film-transparent ",
     {"--background", "use --background transparent"}},
    {" --shadow --shadows --shadow-intensity --shadow-catcher --floor ",
     {"--ground", "use --ground shadow"}},
    {" --quality --noise-threshold --adaptive-threshold ",
     {"--noise", "use --noise N%, --spp N or --time TIME"}},
    {" --time-limit --timeout --max-time --duration ", {"--time", "use --time TIME"}},
    {" --bounces --max-bounces --maxdepth --depth --max-path-length ",
     {"--max-depth", "use --max-depth N, the edges of a path"}},
    {" --region --crop-window --cropwindow --border --rect ", {"--crop", "use --crop X0,Y0,X1,Y1"}},
    {" --passes --layers --aovs --render-passes --channels ", {"--aov", "use --aov NAMES"}},
    {" --denoiser --oidn --clean ", {"--denoise", "use --denoise"}},
    {" --bits --bit-depth --bpp ", {"--png-bits", "use --png-bits 16, or an .exr file"}},
    {" --aperture --fstop --f-number --dof ", {"--f-stop", "use --f-stop N"}},
    {" --focus --focal-distance --focus-dist ",
     {"--focus-distance", "use --focus-distance METRES"}},
    {" --checkpoint --resume --continue ", {"--part", "use --part FILE"}},
    {" --loglevel --log-level --silent --no-progress ", {"--quiet", "use --quiet, or --verbose"}},
    {" --profile --profiling ", {"--stats", "use --stats FILE, or a profiler such as perf"}},
    {" --debug --info --progress ", {"--verbose", "use --verbose"}},
    {" --var --define -D ", {"", "options have names of their own, as in --spp 64"}},
    {" --interactive --preview --gui --window ",
     {"--integrator", "bdpt view SCENE shows a scene while it renders"}},
    {" --usage --manual -? ", {"", "use --help"}},
    {" --metric -metric ", {"--metrics", "use --metrics NAMES"}},
    {" --diff --difference ", {"--error-image", "use --error-image FILE"}},
    {" -v -V --Version ", {"", "use --version"}},
}};

}  // namespace

std::optional<ForeignOption> find_foreign(std::string_view name, const OptionList& options)
{
    const std::string wanted = " " + std::string(name) + " ";
    for (const Foreign& foreign : foreign_options) {
        if (foreign.words.find(wanted) != std::string_view::npos &&
            (foreign.meant.option.empty() || options.find(foreign.meant.option) != nullptr)) {
            return foreign.meant;
        }
    }
    return std::nullopt;
}

}  // namespace bdpt::job
