// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/program.hpp"

#include <glib.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <system_error>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run {
namespace {

// Called in the new process.
void end_with_parent(void* /*data*/) { prctl(PR_SET_PDEATHSIG, SIGTERM); }

int exit_status(int wait_status) {
  if (WIFEXITED(wait_status)) return WEXITSTATUS(wait_status);
  return 128 + (WIFSIGNALED(wait_status) ? WTERMSIG(wait_status) : 0);
}

std::string take(char* text) {
  std::string result = text == nullptr ? "" : text;
  g_free(text);
  return result;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  pointers.reserve(copies.size() + 1);
  for (std::string& argument : copies) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  char* output = nullptr;
  char* errors = nullptr;
  int wait_status = 0;
  GError* error = nullptr;
  if (g_spawn_sync(nullptr, pointers.data(), nullptr, G_SPAWN_SEARCH_PATH, end_with_parent, nullptr,
                   &output, &errors, &wait_status, &error) == FALSE) {
    const bool missing = g_error_matches(error, G_SPAWN_ERROR, G_SPAWN_ERROR_NOENT) != FALSE;
    const std::string reason = missing ? "is not installed, or not in PATH"
                                       : std::string("cannot be started: ") + error->message;
    g_error_free(error);
    throw UserError(arguments.front() + ": " + reason);
  }
  return {exit_status(wait_status), take(output), take(errors)};
}

std::string in_one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::filesystem::path this_program() {
  std::error_code error;
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw UserError("/proc/self/exe: " + error.message());
  return program;
}

}  // namespace mtstereo::run
