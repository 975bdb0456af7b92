#include <bdpt/io/part_file.h>

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <bdpt/render.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "part/part_contents.h"
#include "scene_builder.h"
#include "scratch_folder.h"

namespace bdpt::io::part_file_test {
namespace {

using test::ScratchFolder;

Scene lit_box()
{
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    return Scene(std::move(builder.desc));
}

RenderOptions options()
{
    RenderOptions result;
    result.film.width = 17;
    result.film.height = 11;
    result.film.crop = PixelRect{.x0 = 3, .y0 = 2, .x1 = 15, .y1 = 10};
    result.film.clamp = 8.0f;
    result.film.aovs = {Aov::albedo, Aov::normal,  Aov::depth, Aov::position, Aov::alpha,
                        Aov::shadow, Aov::opacity, Aov::uv,    Aov::distance, Aov::camera_normal};
    result.transport.max_depth = 4;
    result.bidirectional.strategy_depth = 3;
    return result;
}

RenderResult part_of(const RenderOptions& options, SampleRange samples)
{
    RenderOptions o = options;
    o.sampling.samples = samples;
    return render(lit_box(), test::room_camera(), o);
}

PartNotes notes()
{
    PartNotes result{.goal = SampleSet({.begin = 0, .end = 64}),
                     .metadata = {},
                     .command = {"bdpt", "render", "a b.glb"}};
    result.metadata.version = "9.9";
    result.metadata.scene = "a b.glb";
    result.metadata.settings = R"({"spp": 3})";
    result.metadata.integrator = "bdpt";
    result.metadata.seed = 12345678901234567890U;
    result.metadata.camera = test::room_camera();
    result.metadata.camera.name = "front";
    result.metadata.camera.shift = {0.5f, -0.25f};
    result.metadata.origin = {448000.0, 0.0, -512000.25};
    result.metadata.xmp = "{}";
    return result;
}

void check_equal(const RenderResult& a, const RenderResult& b)
{
    CHECK(a.identity == b.identity);
    CHECK(a.samples == b.samples);
    CHECK(a.film.layout() == b.film.layout());
    CHECK(a.film.develop().pixels == b.film.develop().pixels);
    CHECK(a.film.develop_half(0).pixels == b.film.develop_half(0).pixels);
    CHECK(a.film.develop_half(1).pixels == b.film.develop_half(1).pixels);
    CHECK(a.film.sample_count() == b.film.sample_count());
    CHECK(a.film.clamp_loss().contributions == b.film.clamp_loss().contributions);
    CHECK(a.film.clamp_loss().radiance == b.film.clamp_loss().radiance);
    CHECK(a.film.defects().saturated == b.film.defects().saturated);
    CHECK(a.film.defects().invalid == b.film.defects().invalid);
    CHECK(a.film.defects().first_invalid == b.film.defects().first_invalid);
    CHECK(a.aovs == b.aovs);
    CHECK(a.strategies == b.strategies);
    CHECK(a.stats == b.stats);
    CHECK(a.cpu_seconds == b.cpu_seconds);
}

/// The error that reading `file` gives; fails when there is none.
Error error_of(const std::filesystem::path& file)
{
    try {
        const PartInfo info = read_part_info(file);
        RenderResult part;
        merge_part(part, info);
    } catch (const Error& error) {
        CHECK(std::string(error.what()).starts_with(file.string() + ": "));
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        return error;
    }
    FAIL("no error for " << file);
    return {ErrorCode::internal, ""};
}

/// How often this process has asked the system for bytes [proc(5), /proc/pid/io].
long read_calls()
{
    const std::string text = test::read_text("/proc/self/io");
    const std::size_t place = text.find("syscr: ");
    REQUIRE(place != std::string::npos);
    return std::stol(text.substr(place + 7));
}

TEST_CASE("a part file holds all of a part", "[part]")
{
    const ScratchFolder folder;
    for (const IntegratorKind kind :
         {IntegratorKind::bdpt, IntegratorKind::lt, IntegratorKind::pt}) {
        RenderOptions o = options();
        o.integrator = kind;
        o.bidirectional.strategy_depth = kind == IntegratorKind::pt ? 0 : 3;
        RenderResult part = part_of(o, {.begin = 0, .end = 3});
        part.film.add_sample(5, 7, 2, Rgb(std::nanf("")));
        part.film.add_sample(5, 7, 2, Rgb(1e30f));
        REQUIRE(part.film.clamp_loss().contributions > 0);
        const auto file = folder / "a.part.exr";
        CHECK(write_part(file, part, notes(), OldPart::keep_if_more) == PartWrite::written);
        CHECK(folder.names() == std::set<std::string>{"a.part.exr"});

        const PartInfo info = read_part_info(file);
        CHECK(info.identity == part.identity);
        CHECK(info.samples.text() == "0:3");
        CHECK(info.notes.goal.text() == "0:64");
        CHECK(info.notes.command == notes().command);
        CHECK(info.notes.metadata.scene == "a b.glb");
        CHECK(info.notes.metadata.seed == 12345678901234567890U);
        CHECK(info.notes.metadata.camera.name == "front");
        CHECK(info.notes.metadata.camera.shift == Vec2(0.5f, -0.25f));
        CHECK(info.notes.metadata.origin == DVec3(448000.0, 0.0, -512000.25));
        CHECK(info.notes.metadata.camera.world_from_camera ==
              test::room_camera().world_from_camera);
        RenderResult read;
        merge_part(read, info);
        check_equal(read, part);
        // And so does a file of what was read.
        write_part(folder / "b.part.exr", read, notes(), OldPart::replace);
        CHECK(test::read_text(folder / "b.part.exr") == test::read_text(file));
        std::filesystem::remove(folder / "b.part.exr");
        std::filesystem::remove(file);
    }
}

TEST_CASE("long texts of a part file are not read letter by letter", "[part]")
{
    const ScratchFolder folder;
    const RenderResult part = part_of(options(), {.begin = 0, .end = 1});
    PartNotes long_notes = notes();
    long_notes.command.emplace_back(200'000, 'x');
    write_part(folder / "a.part.exr", part, long_notes, OldPart::replace);
    const long before = read_calls();
    const PartInfo info = read_part_info(folder / "a.part.exr");
    CHECK(read_calls() - before < 1000);
    CHECK(info.notes.command == long_notes.command);
}

TEST_CASE("any viewer sees the image of a part file", "[part]")
{
    const ScratchFolder folder;
    const RenderResult part = part_of(options(), {.begin = 0, .end = 2});
    write_part(folder / "a.part.exr", part, notes(), OldPart::replace);
    const test::ExrFile exr = test::read_exr(folder / "a.part.exr");
    CHECK(exr.image.pixels == part.film.develop().pixels);
    CHECK(exr.integer("bdpt.spp") == 2);
    CHECK(exr.header.displayWindow().max.x == 16);
    CHECK(exr.header.dataWindow().min.y == 2);
}

TEST_CASE("merging files of parts is rendering all of their samples", "[part]")
{
    const ScratchFolder folder;
    const RenderResult whole = part_of(options(), {.begin = 0, .end = 7});
    const std::vector<SampleRange> ranges{
        {.begin = 4, .end = 7}, {.begin = 0, .end = 1}, {.begin = 1, .end = 4}};
    RenderResult sum;
    for (const SampleRange& range : ranges) {
        write_part(folder / "a.part.exr", part_of(options(), range), notes(), OldPart::replace);
        merge_part(sum, read_part_info(folder / "a.part.exr"));
    }
    sum.cpu_seconds = whole.cpu_seconds;
    RenderStats stats = whole.stats;
    sum.stats = stats;
    check_equal(sum, whole);
}

TEST_CASE("a part file that was cut off is refused, wherever", "[part]")
{
    const ScratchFolder folder;
    write_part(folder / "a.part.exr", part_of(options(), {.begin = 0, .end = 2}), notes(),
               OldPart::replace);
    const std::string whole = test::read_text(folder / "a.part.exr");
    for (std::size_t length = 0; length < whole.size();
         length +=
         length < 100 || length + 100 > whole.size() ? std::size_t{1} : std::size_t{997}) {
        CAPTURE(length);
        test::write_text(folder / "b.part.exr", whole.substr(0, length));
        REQUIRE(error_of(folder / "b.part.exr").code() == ErrorCode::invalid_input);
    }
    test::write_text(folder / "b.part.exr", whole + "x");
    CHECK(error_of(folder / "b.part.exr").code() == ErrorCode::invalid_input);
    test::write_text(folder / "b.part.exr", whole);
    CHECK_NOTHROW(read_part_info(folder / "b.part.exr"));
}

TEST_CASE("a part file of which one bit has changed is refused, whichever", "[part]")
{
    const ScratchFolder folder;
    write_part(folder / "a.part.exr", part_of(options(), {.begin = 0, .end = 2}), notes(),
               OldPart::replace);
    std::string bytes = test::read_text(folder / "a.part.exr");
    std::mt19937 engine(5);
    std::uniform_int_distribution<std::size_t> bit(0, 7);
    std::vector<std::size_t> places;
    for (std::size_t i = 0;
         i<bytes.size(); i += i + 200> bytes.size() ? std::size_t{1} : std::size_t{401}) {
        places.push_back(i);
    }
    for (const std::size_t place : places) {
        CAPTURE(place);
        const char before = bytes[place];
        bytes[place] = static_cast<char>(before ^ (1 << bit(engine)));
        test::write_text(folder / "b.part.exr", bytes);
        REQUIRE(error_of(folder / "b.part.exr").code() == ErrorCode::invalid_input);
        bytes[place] = before;
    }
}

/// Writes `bytes`, which lack a seal, as a file whose seal holds.
void write_sealed(const std::filesystem::path& path, std::string_view bytes)
{
    OutputFile file(path);
    file.write(bytes);
    seal(file, bytes.size());
    file.commit();
}

TEST_CASE("a part file that lies about itself is refused before it costs memory", "[part][long]")
{
    const ScratchFolder folder;
    write_part(folder / "a.part.exr", part_of(options(), {.begin = 0, .end = 2}), notes(),
               OldPart::replace);
    const std::string sealed = test::read_text(folder / "a.part.exr");
    const std::string bytes = sealed.substr(0, sealed.size() - 40);
    const auto file = folder / "b.part.exr";
    write_sealed(file, bytes);
    REQUIRE(test::read_text(file) == sealed);
    // Of the same length, so that OpenEXR finds everything in its place.
    const std::vector<std::pair<std::string, std::string>> lies{
        {R"("samples":"0:2")", R"("samples":"2:0")"},
        {R"("samples":"0:2")", R"("samples":"   ")"},
        {R"("size":[17,11])", R"("size":[9e9,1])"},
        {R"("region":[3,2,15,10])", R"("region":[3,2,16,10])"},
        {R"("region":[3,2,15,10])", R"("region":[3,2,15,2 ])"},
        {R"("layers":[0,1,13,2,12,3,11,6,10,7])", R"("layers":[0,1,13,2,12,11,6,10,7  ])"},
        {R"("strategies":[[0,2])", R"("strategies":[[0,9])"},
        {R"("format":1)", R"("format":2)"},
        {R"("clamped":)", R"("clamPed":)"},
        {"half0.R.0", "half0.R.9"},
    };
    for (const auto& [truth, lie] : lies) {
        CAPTURE(truth, lie);
        const std::size_t place = bytes.find(truth);
        REQUIRE(place != std::string::npos);
        REQUIRE(truth.size() == lie.size());
        write_sealed(file, std::string(bytes).replace(place, truth.size(), lie));
        const Error error = error_of(file);
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK((std::string(error.what()).find("which a newer bdpt wrote") != std::string::npos) ==
              (lie == R"("format":2)"));
    }
    // Whatever else it says is an error or harmless.
    std::mt19937 engine(9);
    const std::size_t header = bytes.find("bdpt.part") + 6000;
    for (int i = 0; i < 400; ++i) {
        std::string mutant = bytes;
        mutant[engine() % (i % 4 == 0 ? mutant.size() : header)] =
            static_cast<char>(engine() % 256);
        write_sealed(file, mutant);
        try {
            const PartInfo info = read_part_info(file);
            RenderResult part;
            merge_part(part, info);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::invalid_input);
        }
    }
}

TEST_CASE("what is no part file is refused", "[part]")
{
    const ScratchFolder folder;
    CHECK(error_of(folder / "missing.part.exr").code() == ErrorCode::not_found);
    CHECK(error_of(folder.path()).code() == ErrorCode::not_found);
    test::write_text(folder / "text.exr", std::string(5000, 'x'));
    CHECK(error_of(folder / "text.exr").code() == ErrorCode::invalid_input);
}

TEST_CASE("parts of other renders and samples that come twice are refused by name", "[part]")
{
    const ScratchFolder folder;
    const auto file = folder / "a.part.exr";
    write_part(file, part_of(options(), {.begin = 0, .end = 2}), notes(), OldPart::replace);
    const auto message = [&](RenderResult part) {
        try {
            merge_part(part, read_part_info(file));
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::invalid_input);
            return std::string(error.what());
        }
        return std::string("none");
    };
    RenderOptions other = options();
    other.sampling.seed = 4;
    CHECK(message(part_of(other, {.begin = 2, .end = 3})).find("option: seed (0, not 4)") !=
          std::string::npos);
    CHECK(message(part_of(options(), {.begin = 1, .end = 3})).find("1:2") != std::string::npos);

    const PartInfo info = read_part_info(file);
    write_part(file, part_of(options(), {.begin = 0, .end = 3}), notes(), OldPart::replace);
    RenderResult part;
    try {
        merge_part(part, info);
        FAIL("merged");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(std::string(error.what()).find("was replaced") != std::string::npos);
    }
}

TEST_CASE("a part file that is ahead stays, and that of another render does", "[part]")
{
    const ScratchFolder folder;
    const auto file = folder / "a.part.exr";
    const RenderResult more = part_of(options(), {.begin = 0, .end = 4});
    const RenderResult fewer = part_of(options(), {.begin = 0, .end = 2});
    const RenderResult others = part_of(options(), {.begin = 3, .end = 5});
    const auto samples = [&] { return read_part_info(file).samples.text(); };
    CHECK(write_part(file, fewer, notes(), OldPart::keep_if_more) == PartWrite::written);
    CHECK(write_part(file, more, notes(), OldPart::keep_if_more) == PartWrite::written);
    CHECK(write_part(file, fewer, notes(), OldPart::keep_if_more) == PartWrite::kept);
    CHECK(samples() == "0:4");
    CHECK(write_part(file, others, notes(), OldPart::keep_if_more) == PartWrite::written);
    CHECK(samples() == "3:5");

    RenderOptions o = options();
    o.sampling.seed = 4;
    const RenderResult foreign = part_of(o, {.begin = 0, .end = 9});
    try {
        write_part(file, foreign, notes(), OldPart::keep_if_more);
        FAIL("written");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::output);
        CHECK(std::string(error.what()).find("option: seed") != std::string::npos);
    }
    CHECK(samples() == "3:5");
    CHECK(write_part(file, foreign, notes(), OldPart::replace) == PartWrite::written);
    CHECK(samples() == "0:9");
    test::write_text(file, "torn");
    CHECK(write_part(file, fewer, notes(), OldPart::keep_if_more) == PartWrite::written);
    CHECK(folder.names() == std::set<std::string>{"a.part.exr"});
}

TEST_CASE("a part that cannot be written leaves the one before", "[part]")
{
    const ScratchFolder folder;
    const auto file = folder / "a.part.exr";
    write_part(file, part_of(options(), {.begin = 0, .end = 2}), notes(), OldPart::keep_if_more);
    const RenderResult more = part_of(options(), {.begin = 0, .end = 4});
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    rlimit small = before;
    small.rlim_cur = std::filesystem::file_size(file) / 2;
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    std::string message;
    try {
        write_part(file, more, notes(), OldPart::keep_if_more);
    } catch (const Error& error) {
        message = error.what();
        CHECK(error.code() == ErrorCode::output);
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    CHECK(message.find("a.part.exr: cannot write: File too large") != std::string::npos);
    CHECK(folder.names() == std::set<std::string>{"a.part.exr"});
    CHECK(read_part_info(file).samples.text() == "0:2");
}

}  // namespace
}  // namespace bdpt::io::part_file_test
