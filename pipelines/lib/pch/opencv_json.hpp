// SPDX-License-Identifier: LGPL-2.1-or-later
// Precompiled for mtstereo-eval.
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
