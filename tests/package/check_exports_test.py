#!/usr/bin/env python3
"""Tests that check_exports finds each planted violation in a small header and list of symbols."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import check_exports

HEADER = """#pragma once
namespace bdpt {
class World;
enum class MeshId : unsigned {};
class BDPT_EXPORT Film {
public:
    int width() const;
};
class BDPT_EXPORT Error : public std::runtime_error {};
[[nodiscard]] BDPT_EXPORT std::vector<std::pair<int, int>> pairs(
    const Film& film);
BDPT_EXPORT void save(const Film& film);
inline int twice(int value) { return 2 * value; }
}  // namespace bdpt
"""
SYMBOLS = """0000000000001000 T bdpt::Film::width() const
0000000000001010 V vtable for bdpt::Error
0000000000001020 T bdpt::pairs[abi:cxx11](bdpt::Film const&)
0000000000001030 T bdpt::save(bdpt::Film const&)
0000000000001040 V typeinfo for std::bad_variant_access
0000000000001050 W std::vector<float, std::allocator<float> >::push_back(float&&)
0000000000001052 W unsigned long __gnu_cxx::__stoa<unsigned long, char>(char const*)
0000000000001053 W auto std::filesystem::__detail::__effective_range<char [2]>(char const (&) [2])
0000000000001053 W decltype(::new((void*)(0)) std::string(std::declval<char>())) std::construct_at<std::string>(std::string*)
0000000000001053 W decltype (::new((void*)(0)) std::string(std::declval<char>())) std::construct_at<std::string>(std::string*)
0000000000001054 V typeinfo for bool (*)(std::string const&, void*)
0000000000001056 V typeinfo name for bool (std::string const&, void*)
0000000000001058 V vtable for fmt::v10::format_error
0000000000001060 W std::vector<bdpt::MeshId, std::allocator<bdpt::MeshId> >::clear()
"""


class CheckExports(unittest.TestCase):
    def findings(self, header=HEADER, symbols=SYMBOLS):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "film.h").write_text(header, encoding="utf-8")
            return check_exports.check(symbols, folder)[0]

    def test_sound_library_has_no_findings(self):
        self.assertEqual(self.findings(), [])

    def test_foreign_symbols_are_found(self):
        for symbol in ("T bdpt::World::World()", "W bdpt::FilmReader::read()", "T bdpt::saved(int)",
                       "V vtable for bdpt::Integrator", "T rtcNewDevice", "W embree::Scene::build()",
                       "W std::vector<bdpt::World, std::allocator<bdpt::World> >::clear()", "B bdpt::count",
                       "W tinygltf::Model::Model()", "V vtable for fmt::v10::detail::buffer",
                       "W int fmt::v10::format_error::value()", "V typeinfo for bool (bdpt::World const&)",
                       "T bdpt::io::save(bdpt::Film const&)"):
            with self.subTest(symbol):
                found = self.findings(symbols=f"{SYMBOLS}0000000000002000 {symbol}\n")
                self.assertEqual(found, [f"exported, but not public: {symbol[2:]}"])

    def test_copies_from_below_are_not_foreign(self):
        with tempfile.TemporaryDirectory() as folder:
            above, below = pathlib.Path(folder) / "above", pathlib.Path(folder) / "below"
            for path, text in ((above, "namespace bdpt::io {\nBDPT_EXPORT void load();\n}\n"), (below, HEADER)):
                path.mkdir()
                (path / "file.h").write_text(text, encoding="utf-8")
            symbols = "V typeinfo for bdpt::Error\nT bdpt::io::load()\nW std::list<bdpt::MeshId>::clear()\n"
            self.assertEqual(check_exports.check(symbols, above, [below])[0], [])
            self.assertEqual(len(check_exports.check(symbols, above)[0]), 2)

    def test_missing_symbols_are_found(self):
        for line, name in zip(SYMBOLS.splitlines(keepends=True), ("Film", "Error", "pairs", "save")):
            with self.subTest(name):
                self.assertEqual(self.findings(symbols=SYMBOLS.replace(line, "")),
                                 [f"public, but not exported: bdpt::{name}"])

    def test_functions_without_mark_are_found(self):
        for line in ("void load(const Film& film);", "[[nodiscard]] std::vector<int> load(", "Film load(int);"):
            with self.subTest(line):
                found = self.findings(HEADER.replace("}  // name", f"{line}\n}}  // name"))
                self.assertEqual(found, ["film.h: load() is not marked BDPT_EXPORT"])

    def test_unmarked_headers_are_an_error(self):
        self.assertEqual(len(self.findings("#pragma once\nnamespace bdpt {\n}\n", "")), 1)


if __name__ == "__main__":
    unittest.main()
