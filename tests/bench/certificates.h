// What a proof costs beside the hit that it proves.
#pragma once

namespace rondure::bench {

void print_certificates(int rounds);

}  // namespace rondure::bench
