# For the races to source: programs on PATH, and how their seconds and errors are measured.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../../pipelines/common.sh"
source "$here/../../pipelines/reproduce/measure.sh"
need_programs
