// SPDX-License-Identifier: LGPL-2.1-or-later
// A plugin of QEMU that counts the instructions of a program, and prints the count each time the
// program calls mtstereo_step_ends(). instructions.py compiles and loads it.
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>

// The part of QEMU's interface for plugins, version 1, that is needed; Debian has no header of it.
extern "C" {
struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info_t;
using qemu_plugin_id_t = std::uint64_t;
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id,
                                           void (*translated)(qemu_plugin_id_t, qemu_plugin_tb*));
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb* block);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb* block, std::size_t index);
const char* qemu_plugin_insn_symbol(const qemu_plugin_insn* instruction);
void qemu_plugin_register_vcpu_tb_exec_inline(qemu_plugin_tb* block, int operation, void* counter,
                                              std::uint64_t value);
void qemu_plugin_register_vcpu_tb_exec_cb(qemu_plugin_tb* block,
                                          void (*executed)(unsigned int, void*), int registers,
                                          void* data);
[[gnu::visibility("default")]] int qemu_plugin_version = 1;
[[gnu::visibility("default")]] int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info,
                                                       int argc, char** argv);
}

namespace {

constexpr int kAdd = 0;          // QEMU_PLUGIN_INLINE_ADD_U64
constexpr int kNoRegisters = 0;  // QEMU_PLUGIN_CB_NO_REGS

std::uint64_t instructions = 0;

void print(unsigned int, void*) { std::fprintf(stderr, "%" PRIu64 "\n", instructions); }

/// Counts the instructions of each block that QEMU translates, whenever the block is executed.
void count(qemu_plugin_id_t, qemu_plugin_tb* block) {
  qemu_plugin_register_vcpu_tb_exec_inline(block, kAdd, &instructions,
                                           qemu_plugin_tb_n_insns(block));
  const char* symbol = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(block, 0));
  if (symbol != nullptr && std::strcmp(symbol, "mtstereo_step_ends") == 0) {
    qemu_plugin_register_vcpu_tb_exec_cb(block, print, kNoRegisters, nullptr);
  }
}

}  // namespace

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t*, int, char**) {
  qemu_plugin_register_vcpu_tb_trans_cb(id, count);
  return 0;
}
