// Prints the hashes that a module computes: `node run.mjs MODULE`.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]));
for (const name of ["four_bar_f64", "excavator_f64", "four_bar_f32"]) {
    console.log(name, BigInt.asUintN(64, instance.exports[name]()).toString(16));
}
