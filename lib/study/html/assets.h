// The style and the script of index.html.
#pragma once

namespace phos::inline study {

/// What index.html holds between <style> and between <script>.
extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace phos::inline study
