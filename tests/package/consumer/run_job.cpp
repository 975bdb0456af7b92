// Renders a scene as bdpt render does, to run_job.png, and stops it after the first pass: run_job SCENE SKY.
#include <bdpt/error.h>
#include <bdpt/job.h>

#include <cstdio>
#include <filesystem>
#include <stop_token>

int main(int argc, char** argv)
{
    if (argc != 3) {
        return 2;
    }
    bdpt::RenderJob job(argv[1]);
    try {
        job.set("sppp", 4);
        return 1;
    } catch (const bdpt::Error& error) {
        std::printf("as expected: %s\n", error.what());
    }
    job.set("env", argv[2]).set("output", {"run_job.png"}).set("size", 16).set("spp", 1000000);
    std::stop_source source;
    bdpt::JobControl control;
    control.stop = source.get_token();
    control.on_progress = [&](const bdpt::JobProgress&) { source.request_stop(); };
    const bdpt::JobResult result = bdpt::run(job, control);
    std::printf("%d samples per pixel\n", static_cast<int>(result.images.at(0).samples_per_pixel));
    return result.stopped && std::filesystem::file_size("run_job.png") > 0 ? 0 : 1;
}
