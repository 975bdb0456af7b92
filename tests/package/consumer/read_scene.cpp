// Renders the glTF scene of a file under a sky of another one: read_scene SCENE SKY [VOLUME].
#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/volume.h>
#include <bdpt/io/write_image.h>
#include <bdpt/render.h>

#include <cstdio>
#include <utility>

int main(int argc, char** argv)
{
    if (argc < 3) {
        return 2;
    }
    try {
        bdpt::io::LoadedScene loaded = bdpt::io::load_gltf(argv[1]);
        loaded.scene.lights.emplace_back(bdpt::io::load_environment(argv[2]).light);
        if (argc > 3) {
            loaded.scene.volumes.push_back(bdpt::io::load_volume(argv[3]).volume);
        }
        bdpt::RenderOptions options;
        options.film.width = 8;
        options.film.height = 8;
        options.sampling.samples = {0, 4};
        const bdpt::Scene scene(std::move(loaded.scene));
        const bdpt::Image image = bdpt::render(scene, loaded.cameras.at(0), options).film.develop();
        float sum = 0.0f;
        for (const bdpt::Rgb& pixel : image.pixels) {
            sum += pixel.g;
        }
        std::printf("mean radiance %.4f nit\n",
                    static_cast<double>(sum) / static_cast<double>(image.pixels.size()));
        bdpt::io::write_exr("read_scene.exr", image, {});
        return sum > 0.0f ? 0 : 1;
    } catch (const bdpt::Error& error) {
        std::printf("%s\n", error.what());
        return static_cast<int>(error.code());
    }
}
