// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/test_environment.hpp"

int main(int argc, char** argv) { return mtstereo::test::run_tests(argc, argv); }
