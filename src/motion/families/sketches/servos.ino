// @NAME@: hobby servos on a PCA9685 (I2C address 0x40), for an Arduino. Made by plushwright.
// The PCA9685 has its own supply for the servos, 5 to 6 V; its ground joins that of the Arduino.
@HEAD@
// Lines over the serial port, 115200 baud, newline at the end:
//   setup   once: all servos go to their first pulse, WITHOUT cables. Then tie the cables on, just slack.
//   motion  plays the animation from rest, as often as you like. It never sets zero.
//   stop    breaks off, goes slowly back to rest, then switches the servos off.
//   on, off, go MS US US ..., ?   for a computer that plays live.
#include <Arduino.h>
#include <Wire.h>

const uint8_t BOARD = 0x40;
const uint8_t SERVOS = @SERVOS@;
// Pulses at rest and the farthest ones, microseconds.
const uint16_t REST[SERVOS] = {@REST@};
const uint16_t FARTHEST[SERVOS] = {@FARTHEST@};
// Time to the way back to rest, ms.
const uint16_t HOME_MS = @HOME_MS@;
// Rows of the motion: milliseconds since the row before, then the pulse of each servo, microseconds.
const uint16_t ROWS = @ROWS@;
const uint16_t TABLE[ROWS][1 + SERVOS] PROGMEM = {
@TABLE@};

enum State { IDLE, GOING, PLAYING, LEAVING };
State state = IDLE;
uint16_t at[SERVOS];
uint16_t from[SERVOS];
uint16_t to[SERVOS];
uint32_t began = 0;
uint32_t lasts = 0;
uint16_t row = 0;
bool switched_on = false;
char line[160];
uint8_t length = 0;

void write_register(uint8_t address, uint8_t value) {
  Wire.beginTransmission(BOARD);
  Wire.write(address);
  Wire.write(value);
  Wire.endTransmission();
}

// A pulse of so many microseconds at 50 Hz, in steps of 1/4096 of a period; 0 is none.
void pulse(uint8_t servo, uint16_t us) {
  uint16_t off = us == 0 ? 4096 : (uint16_t)(((uint32_t)us * 4096UL + 10000UL) / 20000UL);
  Wire.beginTransmission(BOARD);
  Wire.write(0x06 + 4 * servo);
  Wire.write(0);
  Wire.write(0);
  Wire.write(off & 0xFF);
  Wire.write(off >> 8);
  Wire.endTransmission();
}

void switch_off() {
  for (uint8_t i = 0; i < SERVOS; i++) pulse(i, 0);
  switched_on = false;
  state = IDLE;
}

bool allowed(uint8_t servo, long us) {
  uint16_t low = min(REST[servo], FARTHEST[servo]);
  uint16_t high = max(REST[servo], FARTHEST[servo]);
  return us >= (long)low - 1 && us <= (long)high + 1;
}

void go(const uint16_t *pulses, uint32_t ms, State next) {
  for (uint8_t i = 0; i < SERVOS; i++) {
    from[i] = at[i];
    to[i] = pulses[i];
  }
  began = millis();
  lasts = ms;
  state = next;
  switched_on = true;
}

bool next_row() {
  if (row + 1 >= ROWS) return false;
  row++;
  uint16_t pulses[SERVOS];
  for (uint8_t i = 0; i < SERVOS; i++) pulses[i] = pgm_read_word(&TABLE[row][1 + i]);
  uint32_t due = began + lasts;
  go(pulses, pgm_read_word(&TABLE[row][0]), PLAYING);
  // Rows follow each other without a gap, however late this one is seen.
  began = due;
  return true;
}

void follow() {
  if (state == IDLE) return;
  uint32_t passed = millis() - began;
  bool there = passed >= lasts;
  for (uint8_t i = 0; i < SERVOS; i++) {
    long way = (long)to[i] - (long)from[i];
    at[i] = there ? to[i] : (uint16_t)((long)from[i] + way * (long)passed / (long)lasts);
    if (switched_on) pulse(i, at[i]);
  }
  if (!there) return;
  if (state == PLAYING && next_row()) return;
  if (state == LEAVING) switch_off();
  state = IDLE;
}

const char *go_line(char *words) {
  uint16_t pulses[SERVOS];
  long ms = strtol(words, &words, 10);
  if (ms < 0) return "error time";
  for (uint8_t i = 0; i < SERVOS; i++) {
    char *before = words;
    long us = strtol(words, &words, 10);
    if (words == before) return "error pulses";
    if (!allowed(i, us)) return "error limit";
    pulses[i] = (uint16_t)us;
  }
  if (!switched_on) return "error off";
  go(pulses, (uint32_t)ms, GOING);
  return "ok";
}

const char *obey(char *words) {
  if (strcmp(words, "setup") == 0) {
    for (uint8_t i = 0; i < SERVOS; i++) at[i] = REST[i];
    go(REST, 0, GOING);
  } else if (strcmp(words, "motion") == 0) {
    row = 0;
    // To rest first, where it is not.
    bool rests = true;
    for (uint8_t i = 0; i < SERVOS; i++) rests = rests && at[i] == REST[i];
    go(REST, rests ? 0 : HOME_MS, PLAYING);
  } else if (strcmp(words, "stop") == 0) {
    go(REST, HOME_MS, LEAVING);
  } else if (strcmp(words, "on") == 0) {
    go(at, 0, GOING);
  } else if (strcmp(words, "off") == 0) {
    switch_off();
  } else if (strncmp(words, "go ", 3) == 0) {
    return go_line(words + 3);
  } else if (strcmp(words, "?") == 0) {
    for (uint8_t i = 0; i < SERVOS; i++) {
      if (i > 0) Serial.print(' ');
      Serial.print(at[i]);
    }
    return "";
  } else {
    return "error unknown";
  }
  return "ok";
}

void setup() {
  Serial.begin(115200);
  Wire.begin();
  // Asleep, 50 Hz (25 MHz / 4096 / 50 - 1), awake.
  write_register(0x00, 0x10);
  write_register(0xFE, 121);
  write_register(0x00, 0x20);
  delay(1);
  for (uint8_t i = 0; i < SERVOS; i++) at[i] = REST[i];
  switch_off();
  Serial.println("plushwright servos");
}

void loop() {
  while (Serial.available() > 0) {
    char letter = (char)Serial.read();
    if (letter == '\r') continue;
    if (letter != '\n') {
      if (length < sizeof(line) - 1) line[length++] = letter;
      continue;
    }
    line[length] = 0;
    if (length > 0) Serial.println(obey(line));
    length = 0;
  }
  follow();
}
