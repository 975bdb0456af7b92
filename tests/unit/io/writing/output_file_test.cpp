#include <bdpt/io/output_file.h>

#include <bdpt/error.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <string_view>

#include "catch.hpp"
#include "scratch_folder.h"

namespace bdpt::io::output_file_test {
namespace {

using test::ScratchFolder;
using Names = std::set<std::string>;

/// The error that writing to `file` gives; fails when there is none.
Error error_of(const std::filesystem::path& file)
{
    try {
        check_writable(file);
    } catch (const Error& error) {
        return error;
    }
    FAIL("no error for " << file);
    return {ErrorCode::internal, ""};
}

TEST_CASE("a file beyond the limit of the process is an error and leaves nothing")
{
    const ScratchFolder folder;
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    rlimit small = before;
    small.rlim_cur = 4096;
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    std::string message;
    try {
        OutputFile file(folder / "large.exr");
        file.write(std::string(10000, 'x'));
    } catch (const Error& error) {
        message = error.what();
        CHECK(error.code() == ErrorCode::output);
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    CHECK(message.find("large.exr: cannot write: File too large") != std::string::npos);
    CHECK(folder.names().empty());
    // The thread is as it was.
    sigset_t pending;
    sigset_t blocked;
    ::sigpending(&pending);
    ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
    CHECK(::sigismember(&pending, SIGXFSZ) == 0);
    CHECK(::sigismember(&blocked, SIGXFSZ) == 0);
}

TEST_CASE("an output file appears whole or not at all")
{
    const ScratchFolder folder;
    const auto name = folder / "picture.exr";

    SECTION("without a commit nothing is left")
    {
        {
            OutputFile file(name);
            file.write(std::string_view("half"));
            CHECK(folder.names().size() == 1);
            CHECK_FALSE(std::filesystem::exists(name));
        }
        CHECK(folder.names().empty());
    }
    SECTION("a commit gives it its name")
    {
        OutputFile file(name);
        file.write(std::string_view("whole"));
        file.commit();
        CHECK(folder.names() == Names{"picture.exr"});
        CHECK(test::read_text(name) == "whole");
    }
    SECTION("the file that was there before stays until then")
    {
        test::write_text(name, "old");
        OutputFile file(name);
        file.write(std::string_view("new"));
        CHECK(test::read_text(name) == "old");
        file.commit();
        CHECK(test::read_text(name) == "new");
    }
}

TEST_CASE("an output file can be written out of order")
{
    const ScratchFolder folder;
    OutputFile file(folder / "a.png");
    file.write(std::string_view("....data"));
    CHECK(file.position() == 8);
    file.seek(0);
    file.write(std::string_view("head"));
    CHECK(file.position() == 4);
    file.commit();
    CHECK(test::read_text(folder / "a.png") == "headdata");
}

/// For `name_in_new_process`.
TEST_CASE("prints a temporary name", "[.temporary-name]")
{
    std::cout << "name=" << OutputFile::temporary_path("a.exr").string() << "=\n";
}

/// The name of the temporary file for "a.exr" in another process that runs this program.
std::string name_in_new_process()
{
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const auto close = [](FILE* pipe) { ::pclose(pipe); };
    const std::unique_ptr<FILE, decltype(close)> pipe(
        ::popen(("'" + program + "' '[.temporary-name]'").c_str(), "r"), close);
    REQUIRE(pipe);
    std::string out(4000, ' ');
    out.resize(std::fread(out.data(), 1, out.size(), pipe.get()));
    const std::size_t begin = out.find("name=") + 5;
    return out.substr(begin, out.find('=', begin) - begin);
}

TEST_CASE("the temporary file is in the same folder, with a name of this process alone")
{
    const std::string one = name_in_new_process();
    const std::string other = name_in_new_process();
    const std::regex form("a\\.exr\\.tmp-[A-Za-z0-9_]*-[0-9]+-[0-9a-f]{16}");
    CHECK(std::regex_match(one, form));
    // Not even the same number of a process on a machine of the same name makes names equal.
    const auto digits = [](const std::string& name) { return name.substr(name.size() - 16); };
    CHECK(digits(one) != digits(other));
    const std::string own = OutputFile::temporary_path("some/where/a.exr").string();
    CHECK(own.starts_with("some/where/a.exr.tmp-"));
    CHECK(own.find("-" + std::to_string(::getpid()) + "-") != std::string::npos);
    CHECK(OutputFile::temporary_path("some/where/a.exr") == own);
}

TEST_CASE("two writers of one file do not mix their bytes")
{
    const ScratchFolder folder;
    OutputFile one(folder / "a.exr");
    {
        OutputFile other(folder / "a.exr");
        CHECK(folder.names().size() == 2);
        other.write(std::string_view("the other"));
        one.write(std::string_view("one"));
        other.commit();
        CHECK(test::read_text(folder / "a.exr") == "the other");
    }
    one.commit();
    CHECK(test::read_text(folder / "a.exr") == "one");
    CHECK(folder.names() == Names{"a.exr"});
}

TEST_CASE("a symbolic link is followed, not replaced")
{
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "real");
    test::write_text(folder / "real/a.exr", "old");
    std::filesystem::create_symlink(folder / "real/a.exr", folder / "link.exr");
    OutputFile file(folder / "link.exr");
    file.write(std::string_view("new"));
    file.commit();
    CHECK(std::filesystem::is_symlink(folder / "link.exr"));
    CHECK(test::read_text(folder / "real/a.exr") == "new");
}

TEST_CASE("a place that cannot be written is an output error that names it")
{
    const ScratchFolder folder;
    std::filesystem::path bad;
    std::string reason;
    SECTION("a missing folder")
    {
        bad = folder / "missing/a.exr";
        reason = "there is no folder";
    }
    SECTION("a folder itself")
    {
        bad = folder / "a.exr";
        std::filesystem::create_directory(bad);
        reason = "this is a folder";
    }
    SECTION("below a file")
    {
        test::write_text(folder / "file", "");
        bad = folder / "file/a.exr";
        reason = "a.exr: cannot write: ";
    }
    SECTION("a file system that takes no files")
    {
        bad = "/proc/a.exr";
        reason = "cannot write";
    }
    SECTION("no name")
    {
        bad = folder / "";
        reason = "not a file name";
    }
    SECTION("a name that is too long")
    {
        bad = folder / (std::string(300, 'a') + ".exr");
        reason = "File name too long";
    }
    const Error error = error_of(bad);
    CAPTURE(error.what());
    CHECK(error.code() == ErrorCode::output);
    CHECK(std::string(error.what()).starts_with(bad.string() + ": cannot write: "));
    CHECK(std::string(error.what()).find(reason) != std::string::npos);
}

TEST_CASE("protected files and folders are respected")
{
    if (::geteuid() == 0) {
        WARN("skipped: root may write everywhere");
        return;
    }
    const ScratchFolder folder;
    test::write_text(folder / "a.exr", "mine");
    SECTION("a file")
    {
        REQUIRE(::chmod((folder / "a.exr").c_str(), 0444) == 0);
        CHECK(error_of(folder / "a.exr").code() == ErrorCode::output);
    }
    SECTION("a folder")
    {
        REQUIRE(::chmod(folder.path().c_str(), 0555) == 0);
        const ErrorCode code = error_of(folder / "b.exr").code();
        REQUIRE(::chmod(folder.path().c_str(), 0755) == 0);
        CHECK(code == ErrorCode::output);
    }
    CHECK(test::read_text(folder / "a.exr") == "mine");
}

TEST_CASE("checking a place leaves nothing behind")
{
    const ScratchFolder folder;
    check_writable(folder / "a.exr");
    CHECK(folder.names().empty());
    test::write_text(folder / "a.exr", "old");
    check_writable(folder / "a.exr");
    CHECK(test::read_text(folder / "a.exr") == "old");
}

}  // namespace
}  // namespace bdpt::io::output_file_test
