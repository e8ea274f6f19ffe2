// --update, which every test program takes: stored results are written anew.
#pragma once

namespace phos::test {

/// Was it given?
bool updating_golden();

}  // namespace phos::test
