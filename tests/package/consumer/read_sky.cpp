// Reads an image of one pixel, (1, 1, 1), and writes it as EXR and PNG beside it.
#include <bdpt/error.h>
#include <bdpt/io/display.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>

#include <cstdio>
#include <filesystem>
#include <string>

int main(int argc, char** argv)
{
    if (argc != 2) {
        return 2;
    }
    const std::filesystem::path file(argv[1]);
    const bdpt::Image sky = bdpt::io::load_environment(file).light.radiance.to_image();
    if (sky.width != 1 || sky.height != 1 || sky.at(0, 0) != bdpt::Rgb(1.0f)) {
        std::printf("%d x %d pixels, red %g\n", sky.width, sky.height, sky.at(0, 0).r);
        return 1;
    }
    const std::string stem = std::string(argv[0]) + "-sky";
    bdpt::io::write_exr(stem + ".exr", sky, {});
    bdpt::io::write_png(stem + ".png", bdpt::io::tone_map(sky, 0.0f), {});
    try {
        (void)bdpt::io::load_environment(file / "missing");
    } catch (const bdpt::Error& error) {
        std::printf("as expected: %s\n", error.what());
        return error.code() == bdpt::ErrorCode::not_found ? 0 : 1;
    }
    return 1;
}
