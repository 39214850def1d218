// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/plot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "lib/outputs/user_error.hpp"

extern char** environ;

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

constexpr const char* kScript = "plot.py";

// The script is in the program's own folder in a build, and elsewhere below the same prefix once
// installed. Both are found from the program, so that an installation can be moved.
fs::path script_file() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  if (fs::exists(folder / kScript)) return folder / kScript;
  const fs::path from_programs =
      fs::path(MTSTEREO_PLOT_FOLDER).lexically_relative(MTSTEREO_PROGRAM_FOLDER);
  return (folder / from_programs / kScript).lexically_normal();
}

// File descriptors of a process that is to be started.
class SpawnFiles {
 public:
  SpawnFiles() { posix_spawn_file_actions_init(&actions_); }
  ~SpawnFiles() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnFiles(const SpawnFiles&) = delete;
  SpawnFiles& operator=(const SpawnFiles&) = delete;

  void discard(int descriptor) {
    posix_spawn_file_actions_addopen(&actions_, descriptor, "/dev/null", O_WRONLY, 0);
  }
  void read_standard_input(int descriptor) {
    posix_spawn_file_actions_adddup2(&actions_, descriptor, 0);
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

// Runs a program without a shell. True if it could be started and its exit status was 0.
bool run(std::vector<std::string> words, const SpawnFiles& files) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t pid = 0;
  if (posix_spawn(&pid, argv[0], files.get(), nullptr, argv.data(), environ) != 0) return false;
  int status = 0;
  while (waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::optional<std::string> plot_obstacle() {
  const fs::path script = script_file();
  if (!fs::exists(script)) return "the file " + script.string() + " is missing: install it again";
  SpawnFiles files;
  files.discard(STDERR_FILENO);
  if (run({script.string(), "check"}, files)) return std::nullopt;
  return "Python's matplotlib is not installed: install the Debian package python3-matplotlib";
}

void plot_curves(const fs::path& picture, const nlohmann::json& report) {
  // A file without a name passes the figures, however many they are.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> figures(std::tmpfile(), std::fclose);
  const std::string text = report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (figures == nullptr || std::fwrite(text.data(), 1, text.size(), figures.get()) < text.size() ||
      std::fflush(figures.get()) != 0) {
    throw UserError(picture, "cannot be plotted: a temporary file cannot be written");
  }
  std::rewind(figures.get());
  SpawnFiles files;
  files.read_standard_input(fileno(figures.get()));
  if (!run({script_file().string(), "curve", "-", fs::absolute(picture).string()}, files)) {
    throw UserError(picture, "cannot be plotted");
  }
}

}  // namespace mtstereo::eval
