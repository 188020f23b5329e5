// SPDX-License-Identifier: Apache-2.0
#include "interruption.hpp"
#include "program.hpp"
#include "standard_files.hpp"

int main(int argc, char** argv) {
    octavo::cli::hold_standard_files();
    octavo::cli::heed_signals();
    return octavo::cli::Program().main(argc, argv);
}
