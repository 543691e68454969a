//! Tables as other programs write them, and the values to read from each.

/// Expected reading of a file.
pub(super) struct Wanted {
    /// Possible origin.
    pub origin: &'static str,
    pub bytes: Vec<u8>,
    pub names: &'static [&'static str],
    pub units: &'static [&'static str],
    /// Values row by row; NaN if a value is missing, or the column has words.
    pub rows: &'static [&'static [f64]],
    /// Dialect of the file, in words.
    pub reading: &'static str,
}

/// Missing value.
const NONE: f64 = f64::NAN;

pub(super) fn utf16(text: &str, little: bool, marked: bool) -> Vec<u8> {
    let units = marked
        .then_some(0xfeff)
        .into_iter()
        .chain(text.encode_utf16());
    let bytes = |unit: u16| {
        if little {
            unit.to_le_bytes()
        } else {
            unit.to_be_bytes()
        }
    };
    units.flat_map(bytes).collect()
}

fn latin(text: &str) -> Vec<u8> {
    let byte = |it: char| u8::try_from(u32::from(it)).expect("it is in Latin-1");
    text.chars().map(byte).collect()
}

const TX: &[&str] = &["t", "x"];

const NO_UNITS: &[&str] = &["", ""];

const TWO: &[&[f64]] = &[&[0.0, 1.5], &[0.1, 2.5]];

/// Reading of a text in UTF-8.
fn plain(
    origin: &'static str,
    text: &str,
    names: &'static [&'static str],
    units: &'static [&'static str],
    rows: &'static [&'static [f64]],
    reading: &'static str,
) -> Wanted {
    Wanted {
        origin,
        bytes: text.as_bytes().to_vec(),
        names,
        units,
        rows,
        reading,
    }
}

const POINTS: &str = "UTF-8, `,` between cells, decimal points, names in line 1";

const COMMAS: &str = "UTF-8, `;` between cells, decimal commas, names in line 1";

const TABS: &str = "UTF-8, tabs between cells, decimal points, names in line 1";

pub(super) fn readable() -> Vec<Wanted> {
    let mut files = vec![
        plain(
            "pandas",
            "t,x\n0.0,1.5\n0.1,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "pandas with its index",
            ",t,x\n0,0.0,1.5\n1,0.1,2.5\n",
            &["1", "t", "x"],
            &["", "", ""],
            &[&[0.0, 0.0, 1.5], &[1.0, 0.1, 2.5]],
            POINTS,
        ),
        plain(
            "pandas with missing values",
            "t,x,y\n0.0,,1\n0.1,2.5,nan\n",
            &["t", "x", "y"],
            &["", "", ""],
            &[&[0.0, NONE, 1.0], &[0.1, 2.5, NONE]],
            POINTS,
        ),
        plain(
            "Windows line ends",
            "t,x\r\n0,1.5\r\n0.1,2.5\r\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "line ends of old Macs",
            "t,x\r0,1.5\r0.1,2.5\r",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "no line end at the end",
            "t,x\n0,1.5\n0.1,2.5",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "UTF-8 with a byte order mark",
            "\u{feff}t,x\n0,1.5\n0.1,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "a German spreadsheet",
            "t;x\r\n0;1,5\r\n0,1;2,5\r\n",
            TX,
            NO_UNITS,
            TWO,
            COMMAS,
        ),
        plain(
            "semicolons and points",
            "t;x\n0.0;1.5\n0.1;2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `;` between cells, decimal points, names in line 1",
        ),
        plain(
            "quoted decimal commas",
            "\"t\",\"x\"\n\"0\",\"1,5\"\n\"0,1\",\"2,5\"\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal commas, names in line 1",
        ),
        plain(
            "Excel, which announces its separator",
            "sep=;\r\nt;x\r\n0;1.5\r\n0.1;2.5\r\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `;` between cells, decimal points, names in line 2",
        ),
        plain("tabs", "t\tx\n0\t1.5\n0.1\t2.5\n", TX, NO_UNITS, TWO, TABS),
        plain(
            "tabs with decimal commas and an empty cell",
            "t\tx\n0\t1,5\n0,1\t\n",
            TX,
            NO_UNITS,
            &[&[0.0, 1.5], &[0.1, NONE]],
            "UTF-8, tabs between cells, decimal commas, names in line 1",
        ),
        plain(
            "MATLAB, writematrix",
            "t,x\n0,1.5000e+00\n1.0000e-01,2.5000e+00\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "MATLAB, NaN",
            "t,x\n0,NaN\n0.1,2.5\n",
            TX,
            NO_UNITS,
            &[&[0.0, NONE], &[0.1, 2.5]],
            POINTS,
        ),
        plain(
            "MATLAB, save -ascii with names in a comment",
            "% t x\n   0.0000000e+00   1.5000000e+00\n   1.0000000e-01   2.5000000e+00\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, spaces between cells, decimal points, names in the comment in line 1",
        ),
        plain(
            "numpy, savetxt",
            "# t,x\n0.000000000000000000e+00,1.500000000000000000e+00\n1.000000000000000056e-01,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, names in the comment in line 1",
        ),
        plain(
            "Fortran",
            "  t    x\n 0.0D+00 1.5D+00\n 1.0D-01 2.5D+00\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, spaces between cells, decimal points, names in line 1",
        ),
        plain(
            "ADAMS, tabular export",
            "\"Time (sec)\"\t\".arm.K_x (mm)\"\n0.0\t1.5\n0.1\t2.5\n",
            &["Time", ".arm.K_x"],
            &["sec", "mm"],
            TWO,
            TABS,
        ),
        plain(
            "a title above the names",
            "Plot of K\nModel: arm\n\nTime,X\n0,1.5\n0.1,2.5\n",
            &["Time", "X"],
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, names in line 4; 2 lines before them are not part of the table",
        ),
        plain(
            "a data logger with a preamble and units",
            "Device;Logger 7\nSerial;1234\nt;x;phi\ns;mm;deg\n0;1,5;0\n0,1;2,5;90\n",
            &["t", "x", "phi"],
            &["s", "mm", "deg"],
            &[&[0.0, 1.5, 0.0], &[0.1, 2.5, 90.0]],
            "UTF-8, `;` between cells, decimal commas, names in line 3, units in line 4; 2 lines before them are not part of the table",
        ),
        plain(
            "units in brackets",
            "t [s],x [mm]\n0,1.5\n0.1,2.5\n",
            TX,
            &["s", "mm"],
            TWO,
            POINTS,
        ),
        plain(
            "units as the standards want them",
            "t / s,x / mm\n0,1.5\n0.1,2.5\n",
            TX,
            &["s", "mm"],
            TWO,
            POINTS,
        ),
        plain(
            "a line of units in brackets",
            "t,x\n(s),(mm)\n0,1.5\n0.1,2.5\n",
            TX,
            &["s", "mm"],
            TWO,
            "UTF-8, `,` between cells, decimal points, names in line 1, units in line 2",
        ),
        plain(
            "comments between and behind rows",
            "# made by hand\nt,x\n0,1.5 # start\n\n# break\n0.1,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, names in line 2",
        ),
        plain(
            "a separator at every end",
            "t;x;\n0;1,5;\n0,1;2,5;\n",
            TX,
            NO_UNITS,
            TWO,
            COMMAS,
        ),
        plain(
            "lines of nothing",
            "t,x\n0,1.5\n,\n0.1,2.5\n,,\n"
                .replace(",,\n", ",\n")
                .as_str(),
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "bars",
            "t|x\n0|1.5\n0.1|2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `|` between cells, decimal points, names in line 1",
        ),
        plain(
            "spaces after commas",
            "t, x\n0, 1.5\n0.1, 2.5\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "quotes and separators in names",
            "\"t\",\"x, \"\"left\"\" (mm)\"\n0,1.5\n0.1,2.5\n",
            &["t", "x, \"left\""],
            &["", "mm"],
            TWO,
            POINTS,
        ),
        plain(
            "a line break in a name",
            "t,\"x\nleft\"\n0,1.5\n0.1,2.5\n",
            &["t", "x left"],
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "a column of words",
            "t,state,x\n0,run,1.5\n0.1,run,2.5\n",
            &["t", "state", "x"],
            &["", "", ""],
            &[&[0.0, NONE, 1.5], &[0.1, NONE, 2.5]],
            POINTS,
        ),
        plain(
            "a spreadsheet with errors",
            "t,x\n0,1.5\n0.1,#N/A\n",
            TX,
            NO_UNITS,
            &[&[0.0, 1.5], &[0.1, NONE]],
            POINTS,
        ),
        plain(
            "no names at all",
            "0,1.5\n0.1,2.5\n",
            &["1", "2"],
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, no names, so that columns are called 1, 2, …",
        ),
        plain(
            "a typographic minus",
            "t,x\n0,−1.5\n0.1,2.5\n",
            TX,
            NO_UNITS,
            &[&[0.0, -1.5], &[0.1, 2.5]],
            POINTS,
        ),
    ];
    let german = "t;x [µm]\r\n0;1,5\r\n0,1;2,5\r\n";
    for (origin, bytes, reading) in [
        (
            "UTF-16, little-endian",
            utf16(german, true, true),
            "UTF-16 (little-endian), `;` between cells, decimal commas, names in line 1",
        ),
        (
            "UTF-16, big-endian",
            utf16(german, false, true),
            "UTF-16 (big-endian), `;` between cells, decimal commas, names in line 1",
        ),
        (
            "UTF-16 without a mark",
            utf16(german, true, false),
            "UTF-16 (little-endian), `;` between cells, decimal commas, names in line 1",
        ),
        (
            "Latin-1",
            latin(german),
            "Windows-1252, since it is not UTF-8, `;` between cells, decimal commas, names in line 1",
        ),
    ] {
        files.push(Wanted {
            origin,
            bytes,
            names: TX,
            units: &["", "µm"],
            rows: TWO,
            reading,
        });
    }
    files
}
