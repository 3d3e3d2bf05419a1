//! Pages in a browser. Without Chromium these say `skipped`, and with `CI` set they fail.

use crate::sample;
use std::process::Command;
use tilewright_report::browser::complaints;

#[test]
fn nothing_is_wrong_with_the_sample() {
    let page = sample::page().files().unwrap().remove(0);
    if let Some(complaints) = complaints(&page.bytes) {
        assert_eq!(complaints, [""; 0]);
    }
}

/// Each complaint is seen once, so that the silence of the test above means something.
#[test]
fn what_is_wrong_is_seen() {
    let page = "<!DOCTYPE html><title>Wrong</title><body style='background-color: white; margin: 0'>
        <script>console.error('told so'); nowhere()</script>
        <img src='data:image/png;base64,AAAA' alt=''><img src='http://tilewright.invalid/elsewhere.png' alt=''>
        <div style='width: 500px'>wide</div>";
    let Some(found) = complaints(page.as_bytes()) else { return };
    let mut expected = Vec::new();
    for scheme in ["dark", "light"] {
        for said in ["told so", "nowhere is not defined"] {
            // A frame each.
            let times = found
                .iter()
                .filter(|it| it.starts_with(&format!("in the {scheme} the console says")) && it.contains(said))
                .count();
            assert_eq!(times, 2, "{said} in {found:#?}");
        }
        expected.push(format!("at 390 pixels, {scheme}: the page is 500 pixels wide"));
        for width in [390, 1280] {
            expected.push(format!("at {width} pixels, {scheme}: 2 pictures are not loaded"));
            expected
                .push(format!("at {width} pixels, {scheme}: the page loads http://tilewright.invalid/elsewhere.png"));
            expected.extend((scheme == "dark").then(|| format!("at {width} pixels, dark: the page is light")));
        }
    }
    let measured: Vec<String> = found.into_iter().filter(|it| it.starts_with("at ")).collect();
    assert_eq!(measured, expected);
}

#[test]
fn an_empty_page_is_seen() {
    let Some(found) = complaints(b"<!DOCTYPE html><body style='background-color: black'>") else { return };
    let expected = [
        "at 390 pixels, dark: there is nothing on the page",
        "at 1280 pixels, dark: there is nothing on the page",
        "at 390 pixels, light: there is nothing on the page",
        "at 390 pixels, light: the page is dark",
        "at 1280 pixels, light: there is nothing on the page",
        "at 1280 pixels, light: the page is dark",
    ];
    assert_eq!(found, expected);
}

/// Runs one of these tests where no program is found: whether it passed, and what it said.
fn without_programs(ci: Option<&str>) -> (bool, String) {
    let mut test = Command::new(std::env::current_exe().unwrap());
    test.args(["browser::an_empty_page_is_seen", "--exact"]).env("PATH", "").env_remove("CI");
    let output = test.envs(ci.map(|value| ("CI", value))).output().unwrap();
    let said = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&said).into_owned())
}

#[test]
fn without_a_browser_the_checks_are_skipped() {
    let (passed, said) = without_programs(None);
    assert!(passed && said.contains("skipped: chromium is not installed"), "{said}");
}

#[test]
fn without_a_browser_the_checks_fail_in_ci() {
    let (passed, said) = without_programs(Some("1"));
    assert!(!passed && said.contains("chromium is not installed, and CI is set"), "{said}");
}
