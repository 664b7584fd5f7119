// Stands in for the I2C bus: a PCA9685 that remembers when each channel's pulse ends, 4096 for none.
#pragma once
#include <cstdint>
#include <vector>

struct Bus {
  std::vector<int> written;
  int off[16] = {};
  void begin() {}
  void beginTransmission(uint8_t) { written.clear(); }
  void write(uint8_t value) { written.push_back(value); }
  void endTransmission() {
    if (written.size() == 5) off[(written[0] - 6) / 4] = written[3] | written[4] << 8;
  }
};
extern Bus Wire;
