// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/images/open_module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <vector>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::images {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail() {
  // It names the file, which is the module or a library that the module needs.
  const char* const reason = dlerror();
  throw UserError(std::string("images cannot be read or written: ") +
                  (reason != nullptr ? reason : "unknown reason") +
                  ": install mtstereo again, with the packages that it needs");
}

// Where the dynamic linker searches libraries of this program. dlopen() of a name would do so
// itself, but not in programs with AddressSanitizer: there it searches those of the sanitizer's
// library.
std::vector<fs::path> searched_folders() {
  void* const program = dlopen(nullptr, RTLD_LAZY);
  Dl_serinfo size{};
  if (program == nullptr || dlinfo(program, RTLD_DI_SERINFOSIZE, &size) != 0) return {};
  std::vector<char> memory(size.dls_size);
  auto* const found = reinterpret_cast<Dl_serinfo*>(memory.data());
  if (dlinfo(program, RTLD_DI_SERINFOSIZE, found) != 0) return {};
  if (dlinfo(program, RTLD_DI_SERINFO, found) != 0) return {};
  std::vector<fs::path> folders;
  for (unsigned i = 0; i < found->dls_cnt; ++i)
    folders.emplace_back(found->dls_serpath[i].dls_name);
  return folders;
}

fs::path find(const std::string& name) {
  std::error_code ignored;
  for (const fs::path& folder : searched_folders()) {
    if (fs::exists(folder / name, ignored)) return folder / name;
  }
  return name;
}

}  // namespace

const Codecs& open_module(const std::string& name) {
  const fs::path file = find(name);
  // Lazily: most of the symbols of these libraries are never used.
  void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr) fail();
  void* const codecs = dlsym(module, kCodecs);
  if (codecs == nullptr) fail();
  return *static_cast<const Codecs*>(codecs);
}

}  // namespace mtstereo::images
